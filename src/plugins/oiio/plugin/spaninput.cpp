/* Span files for every program built on OpenImageIO: a reader plug-in, span.imageio.so.
 *
 * Scan lines are read as they are asked for, in any order; memory is one row. The library's cache
 * would take a picture of scan lines as a single tile, so what is too large for that is offered in
 * tiles, which cost no more than the rows they cover. Eight-bit files are sRGB and come
 * premultiplied, as the library wants them, unless "oiio:UnassociatedAlpha" asks for the straight
 * values of the file; half files are linear and premultiplied as they are.
 */
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <spanfile.h>

#include <algorithm>
#include <climits>
#include <cstring>

namespace {

using OIIO::ImageSpec;
using OIIO::TypeDesc;

bool read_proxy(void *user, uint64_t offset, void *bytes, size_t size) {
  auto *proxy = static_cast<OIIO::Filesystem::IOProxy *>(user);
  return proxy->pread(bytes, size, int64_t(offset)) == size;
}

/* Pixels in all that are left to scan lines, and the side of a tile beyond. */
const uint64_t LARGE = uint64_t(1) << 26;
const int TILE = 256;

class SpanInput final : public OIIO::ImageInput {
public:
  ~SpanInput() override { close(); }
  const char *format_name() const override { return "span"; }
  int supports(OIIO::string_view feature) const override { return feature == "ioproxy"; }
  bool valid_file(const std::string &name) const override;
  bool open(const std::string &name, ImageSpec &spec) override {
    return open(name, spec, ImageSpec());
  }
  bool open(const std::string &name, ImageSpec &spec, const ImageSpec &config) override;
  bool close() override;
  bool read_native_scanline(int subimage, int miplevel, int y, int z, void *data) override;
  bool read_native_tile(int subimage, int miplevel, int x, int y, int z, void *data) override;

private:
  bool create_reader();
  void describe();
  bool refuse(const spanfile_fault &fault);
  /* Columns [x0, x1) of row y, as the library wants them. */
  bool read_pixels(int y, int x0, int x1, void *data);

  spanfile_reader *reader_ = nullptr;
  spanfile_info info_ = {};
  bool is_straight_ = false; /* asked for */
};

bool SpanInput::valid_file(const std::string &name) const {
  unsigned char start[SPANFILE_MAGIC_BYTES];
  OIIO::Filesystem::IOFile file(name, OIIO::Filesystem::IOProxy::Read);
  return file.pread(start, sizeof start, 0) == sizeof start && spanfile_is(start, sizeof start);
}

bool SpanInput::refuse(const spanfile_fault &fault) {
  errorf("byte %llu: %s", static_cast<unsigned long long>(fault.offset), fault.reason);
  return false;
}

bool SpanInput::create_reader() {
  spanfile_source source = {};
  source.read = read_proxy;
  source.user = ioproxy();
  source.size = ioproxy()->size();
  spanfile_fault fault;
  if (spanfile_reader_create(&source, &reader_, &fault) != SPANFILE_OK)
    return refuse(fault);
  info_ = spanfile_reader_info(reader_);
  if (info_.width > uint32_t(INT_MAX / 8) || info_.height > uint32_t(INT_MAX)) {
    errorf("%u x %u pixels are more than this library supports", info_.width, info_.height);
    return false;
  }
  return true;
}

void SpanInput::describe() {
  bool is_half = info_.format == SPANFILE_HALF;
  m_spec =
      ImageSpec(int(info_.width), int(info_.height), 4, is_half ? TypeDesc::HALF : TypeDesc::UINT8);
  if (uint64_t(info_.width) * info_.height > LARGE)
    m_spec.tile_width = m_spec.tile_height = TILE;
  m_spec.attribute("oiio:ColorSpace", is_half ? "Linear" : "sRGB");
  if (!is_half && is_straight_)
    m_spec.attribute("oiio:UnassociatedAlpha", 1);
}

bool SpanInput::open(const std::string &name, ImageSpec &spec, const ImageSpec &config) {
  close();
  is_straight_ = config.get_int_attribute("oiio:UnassociatedAlpha", 0) == 1;
  ioproxy_retrieve_from_config(config);
  if (!ioproxy_use_or_open(name))
    return false;
  if (!create_reader()) {
    close();
    return false;
  }
  describe();
  spec = m_spec;
  return true;
}

bool SpanInput::close() {
  if (reader_)
    spanfile_reader_destroy(reader_);
  reader_ = nullptr;
  ioproxy_clear();
  return true;
}

bool SpanInput::read_pixels(int y, int x0, int x1, void *data) {
  spanfile_row row;
  spanfile_fault fault;
  if (spanfile_reader_row(reader_, uint32_t(y), &row, &fault) != SPANFILE_OK)
    return refuse(fault);
  spanfile_row_pixels(info_.format, &row, uint32_t(x0), uint32_t(x1), data);
  if (info_.format == SPANFILE_SRGB8 && !is_straight_)
    OIIO::premult(4, x1 - x0, 1, 1, 0, 4, TypeDesc::UINT8, data, OIIO::AutoStride, OIIO::AutoStride,
                  OIIO::AutoStride, 3, -1);
  return true;
}

bool SpanInput::read_native_scanline(int subimage, int miplevel, int y, int, void *data) {
  lock_guard lock(*this);
  if (!reader_ || !seek_subimage(subimage, miplevel))
    return false;
  if (y < 0 || y >= m_spec.height) {
    errorf("there is no row %d", y);
    return false;
  }
  return read_pixels(y, 0, m_spec.width, data);
}

bool SpanInput::read_native_tile(int subimage, int miplevel, int x, int y, int, void *data) {
  lock_guard lock(*this);
  if (!reader_ || !seek_subimage(subimage, miplevel))
    return false;
  if (x < 0 || x >= m_spec.width || y < 0 || y >= m_spec.height) {
    errorf("there is no tile at %d, %d", x, y);
    return false;
  }
  size_t row_size = size_t(TILE) * spanfile_pixel_size(info_.format);
  int right = std::min(x + TILE, m_spec.width), bottom = std::min(y + TILE, m_spec.height);
  memset(data, 0, TILE * row_size);
  for (int row = y; row < bottom; row++)
    if (!read_pixels(row, x, right, static_cast<char *>(data) + size_t(row - y) * row_size))
      return false;
  return true;
}

} // namespace

/* What the library looks for in a plug-in of this name. */
OIIO_PLUGIN_EXPORTS_BEGIN

OIIO_EXPORT OIIO::ImageInput *span_input_imageio_create() { return new SpanInput; }
OIIO_EXPORT int span_imageio_version = OIIO_PLUGIN_VERSION;
OIIO_EXPORT const char *span_imageio_library_version() { return nullptr; }
OIIO_EXPORT const char *span_input_extensions[] = {"span", nullptr};

OIIO_PLUGIN_EXPORTS_END
