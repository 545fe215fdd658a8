/* Compiled once for the sources of the module: OpenImageIO's headers take most of their time. Each
 * source includes what it needs, whether or not the build uses this. */
#ifndef CS_OIIO_PCH_OPENIMAGEIO_HPP
#define CS_OIIO_PCH_OPENIMAGEIO_HPP

#include <OpenImageIO/color.h>
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#endif
