#pragma once

#include <opencv2/core.hpp>
#include <opencv2/structured_light.hpp>
#include <vector>

#include "capture/bundle.h"
#include "reconstruct/calibration.h"

// Frames to mesh as a user of OpenCV would put it together: a vertex for each pixel that decodes.
// Each step is one function, so that each can be timed.

namespace facescan::bench::opencv {

/// The images of a scan and OpenCV's decoder for its pattern. The images refer to the scan's
/// frames.
struct Input {
    cv::Ptr<cv::structured_light::GrayCodePattern> decoder;
    std::vector<cv::Mat> images;  ///< CV_8U; pattern 0, complement 0, pattern 1, …
};
Input inputOf(const ScanBundle& scan);

/// The stripe that each pixel shows, CV_32F: its middle, as a projector coordinate; 0 where the
/// images vary too little.
cv::Mat decode(const Input& input);

/// Takes away single false codes (median) and the steps between stripes (bilateral filter).
cv::Mat smooth(const cv::Mat& codes);

/// The point of each pixel in mm, CV_32FC3; 0, 0, 0 where there is no code or the range ends.
cv::Mat calibrate(const cv::Mat& codes, const ScanDescription& scan);

struct GridMesh {
    std::vector<cv::Vec3f> points;
    std::vector<cv::Vec3f> normals;
    std::vector<cv::Vec3i> triangles;
};

/// Two triangles for each four pixels that have points, where these are not too far apart.
/// @param mesh  overwritten; its memory is used again
void tessellate(const cv::Mat& points, GridMesh& mesh);

/// Of each vertex, weighted by the area of its triangles.
void addNormals(GridMesh& mesh);

}  // namespace facescan::bench::opencv
