/// counted_scan BUNDLE: reconstructs the scan twice, the second time in memory that is there, for
/// the plugin count.c to count. Prints the names of the sections between the calls of
/// endOfSection(), one a line, in the order of the run.
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "capture/bundle.h"
#include "reconstruct/reconstruct.h"

using namespace facescan;

/// The plugin knows it by its name.
extern "C" [[gnu::noinline]] void endOfSection() {
    asm volatile("" ::: "memory");
}

namespace {

class Sections : public StageObserver {
public:
    Sections() { names_.reserve(4 * kStageCount); }

    void end(const char* name) {
        names_.push_back(name);
        endOfSection();
    }

    void finished(Stage stage) override { end(name(stage)); }

    void print() const {
        for (const char* name : names_) std::puts(name);
    }

private:
    std::vector<const char*> names_;
};

void reconstructTwice(const char* folder) {
    Sections sections;
    const ScanBundle bundle = readBundle(folder);
    Workspace workspace;
    Reconstruction result;
    for (const char* before : {"before first", "before second"}) {
        sections.end(before);
        reconstruct(bundle.frames.view(), bundle.description, {}, workspace, result, &sections);
    }
    sections.print();
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) return 64;
    try {
        reconstructTwice(argv[1]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "counted_scan: %s\n", error.what());
        return 1;
    }
    return 0;
}
