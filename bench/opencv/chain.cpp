#include "bench/opencv/chain.h"

#include <array>
#include <opencv2/imgproc.hpp>

namespace facescan::bench::opencv {
namespace {

constexpr int kMinModulation = 6;  // grey levels, as Options::min_modulation
constexpr float kLongestEdgeMm = 3.0f;

/// The polynomials, arranged so that X, Y and Z are evaluated side by side.
class Polynomials {
public:
    explicit Polynomials(const Calibration& calibration)
        : degree_(calibration.degree), coefficients_(calibration.coefficients[0].size()) {
        for (std::size_t n = 0; n < coefficients_.size(); ++n) {
            for (std::size_t output = 0; output < 3; ++output)
                coefficients_[n][output] = float(calibration.coefficients[output][n]);
        }
    }

    cv::Vec3f at(float u, float v, float w) const {
        std::array<float, 4> sum{};
        std::size_t n = 0;
        float in_u = 1;
        for (int i = 0; i <= degree_; ++i, in_u *= u) {
            float in_v = in_u;
            for (int j = 0; i + j <= degree_; ++j, in_v *= v) {
                float term = in_v;
                for (int k = 0; i + j + k <= degree_; ++k, term *= w, ++n) {
                    for (std::size_t lane = 0; lane < 4; ++lane)
                        sum[lane] += term * coefficients_[n][lane];
                }
            }
        }
        return {sum[0], sum[1], sum[2]};
    }

private:
    int degree_;
    std::vector<std::array<float, 4>> coefficients_;
};

cv::Mat modulationMask(const std::vector<cv::Mat>& images) {
    cv::Mat lightest = images[0].clone();
    cv::Mat darkest = images[0].clone();
    for (const cv::Mat& image : images) {
        cv::max(lightest, image, lightest);
        cv::min(darkest, image, darkest);
    }
    return lightest - darkest >= kMinModulation;
}

/// In a reflected code the upper half of the stripes counts backwards in all bits but the first.
int stripeOf(const cv::Point& projected, int stripes) {
    return projected.x == 0 ? projected.y : stripes - 1 - projected.y;
}

bool near(const cv::Vec3f& a, const cv::Vec3f& b) {
    const cv::Vec3f apart = a - b;
    return apart.dot(apart) < kLongestEdgeMm * kLongestEdgeMm;
}

/// Which vertex each pixel is, CV_32S; −1 where there is none.
cv::Mat numberVertices(const cv::Mat& points, GridMesh& mesh) {
    cv::Mat vertex(points.size(), CV_32S);
    for (int y = 0; y < points.rows; ++y) {
        for (int x = 0; x < points.cols; ++x) {
            const auto& point = points.at<cv::Vec3f>(y, x);
            vertex.at<int>(y, x) = point[2] > 0 ? int(mesh.points.size()) : -1;
            if (point[2] > 0) mesh.points.push_back(point);
        }
    }
    return vertex;
}

void addTriangle(int a, int b, int c, GridMesh& mesh) {
    if (a < 0 || b < 0 || c < 0) return;
    const std::vector<cv::Vec3f>& points = mesh.points;
    if (near(points[a], points[b]) && near(points[b], points[c]) && near(points[c], points[a]))
        mesh.triangles.emplace_back(a, b, c);
}

}  // namespace

Input inputOf(const ScanBundle& scan) {
    const ScanDescription& description = scan.description;
    const Pattern& pattern = description.pattern;
    CV_Assert(pattern.axis == CodeAxis::y);
    const FrameStackView frames = scan.frames.view();
    // OpenCV decodes two axes, each of at least one bit, and the columns' images come first. So
    // that it has no more to do than we, our coarsest pair is its one column bit; see stripeOf().
    cv::structured_light::GrayCodePattern::Params params;
    params.width = 2;
    params.height = pattern.stripes() / 2;

    Input input{cv::structured_light::GrayCodePattern::create(params), {}};
    input.decoder->setWhiteThreshold(0);  // the mask has judged the contrast
    const Rect& image = description.image;
    for (int pair = 0; pair < pattern.bits; ++pair) {
        for (const bool complement : {false, true}) {
            const int index = description.first_frame + pattern.frameIndex(pair, complement);
            const cv::Mat whole(frames.height, frames.width, CV_8U,
                                const_cast<std::uint8_t*>(frames.frame(index)), frames.row_stride);
            input.images.push_back(whole(cv::Rect(image.x, image.y, image.width, image.height)));
        }
    }
    return input;
}

cv::Mat decode(const Input& input) {
    const cv::Mat mask = modulationMask(input.images);
    const int stripes = 1 << (input.images.size() / 2);
    cv::Mat codes(mask.size(), CV_32F, cv::Scalar(0));
    for (int y = 0; y < mask.rows; ++y) {
        for (int x = 0; x < mask.cols; ++x) {
            cv::Point projected;
            if (mask.at<uchar>(y, x) && !input.decoder->getProjPixel(input.images, x, y, projected))
                codes.at<float>(y, x) = float(stripeOf(projected, stripes)) + 0.5f;
        }
    }
    return codes;
}

cv::Mat smooth(const cv::Mat& codes) {
    cv::Mat even;
    cv::medianBlur(codes, even, 5);
    cv::Mat smoothed;
    cv::bilateralFilter(even, smoothed, 7, 2, 2);
    smoothed.setTo(0, codes == 0);
    return smoothed;
}

cv::Mat calibrate(const cv::Mat& codes, const ScanDescription& scan) {
    const Calibration& calibration = scan.calibration;
    const Polynomials polynomials(calibration);
    cv::Mat points(codes.size(), CV_32FC3, cv::Scalar::all(0));
    for (int y = 0; y < codes.rows; ++y) {
        const float v = float(calibration.y(scan.image.y + y));
        for (int x = 0; x < codes.cols; ++x) {
            const float code = codes.at<float>(y, x);
            if (code <= 0) continue;
            const float u = float(calibration.x(scan.image.x + x));
            const cv::Vec3f point = polynomials.at(u, v, float(calibration.code(code)));
            if (point[2] >= calibration.range_min_mm && point[2] <= calibration.range_max_mm)
                points.at<cv::Vec3f>(y, x) = point;
        }
    }
    return points;
}

void tessellate(const cv::Mat& points, GridMesh& mesh) {
    mesh.points.clear();
    mesh.triangles.clear();
    const cv::Mat vertex = numberVertices(points, mesh);
    for (int y = 0; y + 1 < vertex.rows; ++y) {
        const int* upper = vertex.ptr<int>(y);
        const int* lower = vertex.ptr<int>(y + 1);
        for (int x = 0; x + 1 < vertex.cols; ++x) {
            addTriangle(upper[x], lower[x], upper[x + 1], mesh);
            addTriangle(upper[x + 1], lower[x], lower[x + 1], mesh);
        }
    }
}

void addNormals(GridMesh& mesh) {
    mesh.normals.assign(mesh.points.size(), {0, 0, 0});
    for (const cv::Vec3i& triangle : mesh.triangles) {
        const cv::Vec3f& corner = mesh.points[triangle[0]];
        const cv::Vec3f normal =
            (mesh.points[triangle[1]] - corner).cross(mesh.points[triangle[2]] - corner);
        for (int k = 0; k < 3; ++k) mesh.normals[triangle[k]] += normal;
    }
    for (cv::Vec3f& normal : mesh.normals) normal = cv::normalize(normal);
}

}  // namespace facescan::bench::opencv
