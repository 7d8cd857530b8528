#include "reconstruct/tessellate.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <set>

#include "reconstruct/grids.h"
#include "reconstruct/lay_mesh.h"
#include "reconstruct/mesh_topology.h"
#include "reconstruct/normals.h"

namespace facescan {
namespace {

using namespace test;

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

struct Mounting {
    CodeAxis axis;
    bool rising;
};

constexpr Mounting kMountings[] = {
    {CodeAxis::y, true}, {CodeAxis::y, false}, {CodeAxis::x, true}, {CodeAxis::x, false}};

/// A grid and the points of its cells, as a camera sees them that looks along Z.
struct Sheet {
    ScanDescription scan;
    bool rising = true;
    VertexGrid grid;
    PointPlanes points;
    EdgeNoise noise;

    /// Every pixel is 0.4 mm wide, at the depth that `depth` gives the cell.
    Sheet(
        const Mounting& mounting, int codes, int columns, const GridField& y,
        const GridField& depth = [](int, int) { return 400.0; })
        : rising(mounting.rising), grid(makeGrid(codes, columns, y)) {
        scan.pattern.axis = mounting.axis;
        scan.image = {30, 20, 300, 200};
        points.resize(grid.size() + VertexGrid::kBeyond);
        for (int code = 1; code < codes; ++code) {
            for (int column = 0; column < columns; ++column) {
                const std::size_t i = grid.index(code, column);
                const bool turned = mounting.axis == CodeAxis::x;
                const float across = 0.4f * float(column);
                const float along = 0.4f * grid.y[i];
                points.set(i, {turned ? along : across, turned ? across : along,
                               float(depth(code, column))});
            }
        }
    }

    Mesh tessellated(const Options& options = {}) const {
        Tessellator tessellator;
        tessellator.run(*this, options);
        return tessellator.mesh;
    }

    /// The stages from the grid to the mesh, and their memory.
    struct Tessellator {
        TessellateScratch scratch;
        Quads quads;
        NormalScratch normal_scratch;
        PointPlanes normals;
        LayMeshScratch lay_scratch;
        Mesh mesh;

        void run(const Sheet& sheet, const Options& options) {
            tessellate(options, sheet.grid, sheet.points, sheet.rising, scratch, quads);
            const float side = turnsClockwise(sheet.scan.pattern, sheet.rising) ? -1.0f : 1.0f;
            computeNormals(sheet.grid, sheet.points, quads, side, normal_scratch, normals);
            layMesh(sheet.scan, sheet.grid, sheet.points, normals, quads, sheet.rising, sheet.noise,
                    lay_scratch, mesh);
        }
    };
};

GridField plane(const Mounting& mounting) {
    return [=](int code, int column) {
        const double place = 4.0 * code + 0.1 * column;
        return mounting.rising ? place : 200 - place;
    };
}

TEST(Tessellate, MakesTwoTrianglesOfEveryQuad) {
    for (const Mounting& mounting : kMountings) {
        const Mesh mesh = Sheet(mounting, 13, 21, plane(mounting)).tessellated();
        EXPECT_EQ(mesh.vertices.size(), 12u * 21u);
        EXPECT_EQ(mesh.triangles.size(), 2u * 11u * 20u);
        EXPECT_EQ(countBoundaryEdges(mesh), 2 * (11 + 20));
        EXPECT_EQ(findFlaws(mesh), MeshFlaws{});
    }
}

TEST(Tessellate, MakesOneTriangleOfThreeCells) {
    for (int missing = 0; missing < 4; ++missing) {
        const Sheet sheet({CodeAxis::y, true}, 3, 2, [=](int code, int column) {
            return 2 * (code - 1) + column == missing ? kNothing : 4.0 * code;
        });
        const Mesh mesh = sheet.tessellated();
        EXPECT_EQ(mesh.vertices.size(), 3u);
        EXPECT_EQ(mesh.triangles.size(), 1u);
        EXPECT_EQ(findFlaws(mesh), MeshFlaws{});
    }
}

TEST(Tessellate, CutsAQuadAlongItsShorterDiagonal) {
    for (const double skew : {2.0, -2.0}) {
        const Sheet sheet({CodeAxis::y, true}, 3, 2,
                          [=](int code, int column) { return 20 + 4.0 * code + skew * column; });
        const Mesh mesh = sheet.tessellated();
        ASSERT_EQ(mesh.triangles.size(), 2u);
        // The vertices of both triangles are the ends of the cut.
        std::set<std::pair<float, float>> cut;
        for (const std::uint32_t a : mesh.triangles[0]) {
            for (const std::uint32_t b : mesh.triangles[1]) {
                if (a == b) cut.insert({mesh.vertices[a].x, mesh.vertices[a].y});
            }
        }
        const auto place = [&](int code, int column) {
            const Point p = sheet.points[sheet.grid.index(code, column)];
            return std::pair{p.x, p.y};
        };
        const bool falling = skew < 0;
        EXPECT_EQ(cut, (falling ? std::set{place(1, 0), place(2, 1)}
                                : std::set{place(1, 1), place(2, 0)}));
    }
}

TEST(Tessellate, LeavesOutTrianglesThatSpanAGap) {
    // Two sheets 50 mm apart in depth; their edges are about 1.7 mm long.
    for (const Mounting& mounting : kMountings) {
        const Sheet sheet(mounting, 20, 40, plane(mounting),
                          [](int, int column) { return column < 15 ? 400.0 : 450.0; });
        const Mesh mesh = sheet.tessellated();
        EXPECT_EQ(mesh.triangles.size(), 2u * 18u * (14u + 24u));
        for (const Triangle& t : mesh.triangles) {
            EXPECT_EQ(mesh.vertices[t[0]].z, mesh.vertices[t[1]].z);
            EXPECT_EQ(mesh.vertices[t[0]].z, mesh.vertices[t[2]].z);
        }
        EXPECT_EQ(findFlaws(mesh), MeshFlaws{});
    }
}

TEST(Tessellate, MeasuresGapsByTheMeanOfTheLongestEdges) {
    // All triangles' longest edges are about 1.6 mm, but for one column of triangles.
    const auto sheet = [](double gap) {
        return Sheet(
            {CodeAxis::y, true}, 20, 200, [](int code, int) { return 4.0 * code; },
            [=](int, int column) { return column < 100 ? 400.0 : 400.0 + gap; });
    };
    const double usual = std::hypot(4 * 0.4, 0.4);
    const std::size_t all = 2 * 18 * 199;
    EXPECT_EQ(sheet(6.5 * usual).tessellated().triangles.size(), all);
    EXPECT_LT(sheet(7.5 * usual).tessellated().triangles.size(), all);
    Options options;
    options.max_edge_ratio = 9;
    EXPECT_EQ(sheet(7.5 * usual).tessellated(options).triangles.size(), all);
}

TEST(Tessellate, LeavesOutTrianglesSeenFromBehind) {
    // One edge of a column has slipped past its neighbours.
    const Sheet sheet({CodeAxis::y, true}, 12, 12, [](int code, int column) {
        return 4.0 * code + (code == 6 && column == 6 ? 9 : 0);
    });
    const Mesh mesh = sheet.tessellated();
    EXPECT_LT(mesh.triangles.size(), 2u * 10u * 11u);
    EXPECT_GT(mesh.triangles.size(), 2u * 10u * 11u - 8u);
    EXPECT_EQ(findFlaws(mesh), MeshFlaws{});
}

TEST(Tessellate, GivesTextureCoordinatesByTheFormat) {
    for (const Mounting& mounting : kMountings) {
        const Sheet sheet(mounting, 13, 21, plane(mounting));
        const Mesh mesh = sheet.tessellated();
        const Rect& image = sheet.scan.image;
        for (const Vertex& v : mesh.vertices) {
            // The sheet's points are places of the crop times 0.4 mm.
            const double x = v.x / 0.4 + image.x;
            const double y = v.y / 0.4 + image.y;
            ASSERT_NEAR(v.s, (x - image.x + 0.5) / image.width, 1e-5);
            ASSERT_NEAR(v.t, 1 - (y - image.y + 0.5) / image.height, 1e-5);
        }
    }
}

TEST(Tessellate, TellsFilledVerticesFromMeasuredOnes) {
    const Mounting mounting{CodeAxis::y, true};
    Sheet sheet(mounting, 13, 21, plane(mounting));
    sheet.noise.grey_levels = 4;
    const std::size_t filled = sheet.grid.index(5, 5);
    sheet.grid.cell[filled] = Cell::filled;
    sheet.grid.contrast[filled] = 0;
    const std::size_t faint = sheet.grid.index(7, 7);
    sheet.grid.contrast[faint] = 1;
    float faint_quality = 1, usual_quality = 0;
    int unmeasured = 0;
    for (const Vertex& v : sheet.tessellated().vertices) {
        EXPECT_GE(v.quality, 0);
        EXPECT_LE(v.quality, 1);
        unmeasured += v.quality == 0;
        if (v.x == sheet.points[filled].x && v.y == sheet.points[filled].y) {
            EXPECT_EQ(v.quality, 0);
        } else if (v.x == sheet.points[faint].x && v.y == sheet.points[faint].y) {
            faint_quality = v.quality;
        } else {
            usual_quality = v.quality;
        }
    }
    EXPECT_EQ(unmeasured, 1);
    EXPECT_GT(faint_quality, 0);
    EXPECT_LT(faint_quality, usual_quality) << "noise counts for more where contrast is low";
}

TEST(Tessellate, OverwritesTheMeshOfTheScanBefore) {
    const Mounting mounting{CodeAxis::y, true};
    Sheet::Tessellator tessellator;
    const Sheet large(mounting, 40, 50, plane(mounting));
    const Sheet small(mounting, 13, 21, plane(mounting));
    for (const Sheet* sheet : {&large, &small}) {
        tessellator.run(*sheet, {});
    }
    const Mesh& mesh = tessellator.mesh;
    EXPECT_EQ(mesh.vertices.size(), 12u * 21u);
    EXPECT_EQ(findFlaws(mesh), MeshFlaws{});
}

TEST(Tessellate, MakesAnEmptyMeshOfAnEmptyGrid) {
    const Mesh mesh =
        Sheet({CodeAxis::y, true}, 16, 16, [](int, int) { return kNothing; }).tessellated();
    EXPECT_TRUE(mesh.vertices.empty());
    EXPECT_TRUE(mesh.triangles.empty());
}

/// A grid with random holes, random places and random jumps of depth.
Sheet anySheet() {
    const Mounting mounting = kMountings[*rc::gen::inRange(0, 4)];
    const int codes = *rc::gen::inRange(2, 14);
    const int columns = *rc::gen::inRange(2, 20);
    const int kept_percent = *rc::gen::inRange(20, 100);
    const int jitter = *rc::gen::inRange(0, 60);  // tenths of a pixel
    const GridField surface = plane(mounting);
    return Sheet(
        mounting, codes, columns,
        [&](int code, int column) {
            if (*rc::gen::inRange(0, 100) >= kept_percent) return kNothing;
            return surface(code, column) + 0.1 * *rc::gen::inRange(-jitter, jitter + 1);
        },
        [](int, int) { return *rc::gen::inRange(0, 10) == 0 ? 430.0 : 400.0; });
}

TEST(TessellateProperty, MakesAManifoldOfAnyGrid) {
    EXPECT_TRUE(rc::check([] {
        const Sheet sheet = anySheet();
        const Mesh mesh = sheet.tessellated();
        MeshFlaws flaws = findFlaws(mesh);
        // Points at odds with their places in the image may turn a triangle in space.
        flaws.seen_from_behind = 0;
        RC_ASSERT(flaws == MeshFlaws{});
    }));
}

TEST(TessellateProperty, ShowsItsFrontToTheCamera) {
    EXPECT_TRUE(rc::check([] {
        Sheet sheet = anySheet();
        std::fill(sheet.points.z.begin(), sheet.points.z.end(), 4000.0f);
        RC_ASSERT(findFlaws(sheet.tessellated()).seen_from_behind == 0);
    }));
}

}  // namespace
}  // namespace facescan
