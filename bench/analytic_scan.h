#pragma once

#include "capture/bundle.h"

namespace facescan::bench {

/// A scan of an ellipsoid of a head's size with a nose, by an ideal scanner, with sensor noise of
/// one grey level. It needs no ray casting and takes about 0.2 s a megapixel; same sizes, same
/// scan.
///
/// @param height  px; the picture grows with it, so that the surface covers the same share of it,
/// and
///                the stripes get narrower, so that one covers 3.6 px at 400 mm. They must suffice:
///                2^bits ≥ height / 3.
ScanBundle analyticScan(int width, int height, int bits);

}  // namespace facescan::bench
