/* A TCG plugin of qemu-arm that counts what a program executes, by class of instruction, and what
 * misses a Cortex-A8's caches, apart for each section of the run: a section ends where the program
 * calls its function endOfSection(). Plugin argument: out=FILE, a table with a line a section. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "qemu_plugin.h"

#define EXPORT __attribute__((visibility("default")))

/* ---- What is counted ------------------------------------------------------------------------- */

enum {
    kMul,
    kBranch,
    kLoad,
    kStore,
    kNeonInt,
    kNeonFloat,
    kNeonLoad,
    kNeonStore,
    kF32,
    kF64,
    kDivSqrt,
    kToCore,
    kInt,
    kL1Miss,
    kL2Miss,
    kCounters
};

static const char* const kNames[kCounters] = {
    "mul", "branch", "load",     "store",   "neon_int", "neon_float", "neon_load", "neon_store",
    "f32", "f64",    "div_sqrt", "to_core", "int",      "l1_miss",    "l2_miss",
};
enum { kClasses = kL1Miss }; /* the counters of instructions come first */

enum { kMaxSections = 128 };
static uint64_t running[kCounters];              /* since the start */
static uint64_t at_end[kMaxSections][kCounters]; /* the same at the end of each section */
static int sections;
static const char* table_file;

/* ---- Classes of instructions ----------------------------------------------------------------- */

static bool startsWith(const char* text, const char* start) {
    return strncmp(text, start, strlen(start)) == 0;
}

static bool startsWithOneOf(const char* text, const char* const* starts) {
    for (; *starts; ++starts)
        if (startsWith(text, *starts)) return true;
    return false;
}

/* Vector and floating-point instructions: all begin with v. An operand s0 … s31 tells VFP's single
 * precision from NEON's. */
static int vectorClass(const char* mnemonic, char operand) {
    if (startsWith(mnemonic, "vld") || startsWith(mnemonic, "vpop")) return kNeonLoad;
    if (startsWith(mnemonic, "vst") || startsWith(mnemonic, "vpush")) return kNeonStore;
    if (startsWith(mnemonic, "vmrs")) return kToCore;
    if (startsWith(mnemonic, "vmov") && operand == 'r') return kToCore;
    if (startsWith(mnemonic, "vdiv") || startsWith(mnemonic, "vsqrt")) return kDivSqrt;
    if (strstr(mnemonic, ".f64")) return kF64;
    if (operand == 's') return kF32;
    return strstr(mnemonic, ".f32") ? kNeonFloat : kNeonInt;
}

/* text: "mnemonic operand, ..." */
static int classOf(const char* text) {
    static const char* const loads[] = {"ldr", "ldm", "pop", NULL};
    static const char* const stores[] = {"str", "stm", "push", NULL};
    static const char* const not_branches[] = {"bic", "bfi", "bfc", NULL};
    static const char* const branches[] = {"b", "cbz", "cbnz", "tbb", "tbh", NULL};

    char mnemonic[24] = "";
    char operand = 0;
    sscanf(text, "%23s %c", mnemonic, &operand);
    if (mnemonic[0] == 'v') return vectorClass(mnemonic, operand);
    if (startsWithOneOf(mnemonic, loads)) return kLoad;
    if (startsWithOneOf(mnemonic, stores)) return kStore;
    if (startsWithOneOf(mnemonic, not_branches)) return kInt;
    if (startsWithOneOf(mnemonic, branches)) return kBranch;
    if (strstr(mnemonic, "mul") || strstr(mnemonic, "mla") || strstr(mnemonic, "mls")) return kMul;
    return kInt;
}

/* ---- Caches ---------------------------------------------------------------------------------- */

enum { kLineShift = 6, kMaxLines = 4096 };

struct Cache {
    unsigned ways;
    unsigned sets;
    uint64_t clock;
    uint64_t line[kMaxLines]; /* by set and way; 0: none */
    uint64_t used[kMaxLines]; /* when */
};
/* The Cortex-A8's data cache and the smallest second level that is sold with it. */
static struct Cache level1 = {.ways = 4, .sets = (32 << 10 >> kLineShift) / 4};
static struct Cache level2 = {.ways = 8, .sets = (256 << 10 >> kLineShift) / 8};

/* Whether the line is there. Afterwards it is, in the place of the one not used for longest. */
static bool hit(struct Cache* cache, uint64_t line) {
    const unsigned first = (unsigned)(line % cache->sets) * cache->ways;
    unsigned oldest = first;
    ++cache->clock;
    for (unsigned i = first; i < first + cache->ways; ++i) {
        if (cache->line[i] == line) {
            cache->used[i] = cache->clock;
            return true;
        }
        if (cache->used[i] < cache->used[oldest]) oldest = i;
    }
    cache->line[oldest] = line;
    cache->used[oldest] = cache->clock;
    return false;
}

static void accessed(unsigned cpu, qemu_plugin_meminfo_t info, uint64_t address, void* data) {
    (void)cpu, (void)data;
    const uint64_t last = address + (1u << qemu_plugin_mem_size_shift(info)) - 1;
    for (uint64_t line = address >> kLineShift; line <= last >> kLineShift; ++line) {
        if (hit(&level1, line)) continue;
        ++running[kL1Miss];
        if (!hit(&level2, line)) ++running[kL2Miss];
    }
}

/* ---- The run --------------------------------------------------------------------------------- */

static void endSection(unsigned cpu, void* data) {
    (void)cpu, (void)data;
    if (sections == kMaxSections) {
        fprintf(stderr, "count: more than %d sections\n", kMaxSections);
        exit(1);
    }
    memcpy(at_end[sections++], running, sizeof running);
}

static void translated(qemu_plugin_id_t id, struct qemu_plugin_tb* block) {
    (void)id;
    uint64_t in_block[kClasses] = {0};
    for (size_t i = 0; i < qemu_plugin_tb_n_insns(block); ++i) {
        struct qemu_plugin_insn* instruction = qemu_plugin_tb_get_insn(block, i);
        char* text = qemu_plugin_insn_disas(instruction);
        ++in_block[classOf(text)];
        free(text);
        qemu_plugin_register_vcpu_mem_cb(instruction, accessed, QEMU_PLUGIN_CB_NO_REGS,
                                         QEMU_PLUGIN_MEM_RW, NULL);
    }
    for (int c = 0; c < kClasses; ++c) {
        if (in_block[c]) {
            qemu_plugin_register_vcpu_tb_exec_inline(block, QEMU_PLUGIN_INLINE_ADD_U64, &running[c],
                                                     in_block[c]);
        }
    }
    /* A call enters a function by a block of its own. */
    struct qemu_plugin_insn* first = qemu_plugin_tb_get_insn(block, 0);
    const char* symbol = qemu_plugin_insn_symbol(first);
    if (symbol && strcmp(symbol, "endOfSection") == 0) {
        qemu_plugin_register_vcpu_insn_exec_cb(first, endSection, QEMU_PLUGIN_CB_NO_REGS, NULL);
    }
}

static void writeTable(qemu_plugin_id_t id, void* data) {
    (void)id;
    endSection(0, data);
    FILE* table = fopen(table_file, "w");
    if (!table) {
        perror(table_file);
        return;
    }
    for (int c = 0; c < kCounters; ++c) {
        fprintf(table, "%s%c", kNames[c], c + 1 < kCounters ? '\t' : '\n');
    }
    for (int s = 0; s < sections; ++s) {
        for (int c = 0; c < kCounters; ++c) {
            const uint64_t before = s > 0 ? at_end[s - 1][c] : 0;
            fprintf(table, "%" PRIu64 "%c", at_end[s][c] - before, c + 1 < kCounters ? '\t' : '\n');
        }
    }
    fclose(table);
}

EXPORT int qemu_plugin_version = 1;

EXPORT int qemu_plugin_install(qemu_plugin_id_t id, const struct qemu_info_t* info, int argc,
                               char** argv) {
    if (strcmp(info->target_name, "arm") != 0 || argc != 1 || !startsWith(argv[0], "out=")) {
        fprintf(stderr, "count: for qemu-arm, with the argument out=FILE\n");
        return -1;
    }
    table_file = strdup(argv[0] + strlen("out="));
    qemu_plugin_register_vcpu_tb_trans_cb(id, translated);
    qemu_plugin_register_atexit_cb(id, writeTable, NULL);
    return 0;
}
