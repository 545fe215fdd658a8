/* What the readers of this folder share. Scan lines are read when they are requested, in any order.
 * The library's cache would treat a picture of scan lines as a single tile, so larger pictures are
 * offered in tiles, which are parts of scan lines. */
#pragma once

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <climits>
#include <cstdint>
#include <cstring>

/* A rectangle of pixels inside a picture. */
struct Part {
  int x, y, columns, rows;
};

class PartInput : public OIIO::ImageInput {
public:
  using OIIO::ImageInput::open;
  bool open(const std::string &name, OIIO::ImageSpec &spec) override {
    return open(name, spec, OIIO::ImageSpec());
  }
  int supports(OIIO::string_view feature) const override { return feature == "ioproxy"; }
  bool read_native_scanline(int subimage, int miplevel, int y, int, void *data) override {
    lock_guard lock(*this);
    if (!is_open() || !seek_subimage(subimage, miplevel))
      return false;
    if (y < 0 || y >= m_spec.height) {
      errorf("there is no row %d", y);
      return false;
    }
    return read_part({0, y, m_spec.width, 1}, data, m_spec.scanline_bytes());
  }
  bool read_native_tile(int subimage, int miplevel, int x, int y, int, void *data) override {
    lock_guard lock(*this);
    if (!is_open() || !seek_subimage(subimage, miplevel))
      return false;
    if (x < 0 || x >= m_spec.width || y < 0 || y >= m_spec.height) {
      errorf("there is no tile at %d, %d", x, y);
      return false;
    }
    memset(data, 0, m_spec.tile_bytes());
    return read_part({x, y, std::min(TILE, m_spec.width - x), std::min(TILE, m_spec.height - y)},
                     data, TILE * m_spec.pixel_bytes());
  }

protected:
  virtual bool is_open() const = 0;
  /* stride: bytes from row to row. The caller has locked the lock. */
  virtual bool read_part(const Part &part, void *data, size_t stride) = 0;

  bool open_bytes(const std::string &name, const OIIO::ImageSpec &config) {
    ioproxy_retrieve_from_config(config);
    return ioproxy_use_or_open(name);
  }
  /* The end of opening: gives the description of the picture, or closes what was opened. */
  bool finish(bool is_good, OIIO::ImageSpec &spec) {
    if (is_good)
      spec = m_spec;
    else
      close();
    return is_good;
  }
  /* The open file as a spanfile_source or a planefile_source. */
  template <class Source> Source source() {
    Source out = {};
    out.read = [](void *user, uint64_t offset, void *bytes, size_t size) {
      auto *proxy = static_cast<OIIO::Filesystem::IOProxy *>(user);
      return proxy->pread(bytes, size, int64_t(offset)) == size;
    };
    out.user = ioproxy();
    out.size = ioproxy()->size();
    return out;
  }
  /* fault: a spanfile_fault or a planefile_fault. */
  template <class Fault> bool refuse(const Fault &fault) {
    errorf("byte %llu: %s", static_cast<unsigned long long>(fault.offset), fault.reason);
    return false;
  }
  /* Sets m_spec. The library counts the bytes of a row and the tiles of a picture with int. */
  bool describe(uint32_t width, uint32_t height, OIIO::TypeDesc type, const char *space) {
    auto tiles = [](uint64_t side) { return (side + TILE - 1) / TILE; };
    if (width * uint64_t(4 * type.size()) > INT_MAX || height > INT_MAX ||
        tiles(width) * tiles(height) > INT_MAX) {
      errorf("%u x %u pixels are more than OpenImageIO supports", width, height);
      return false;
    }
    m_spec = OIIO::ImageSpec(int(width), int(height), 4, type);
    if (m_spec.image_pixels() > LARGE)
      m_spec.tile_width = m_spec.tile_height = TILE;
    m_spec.attribute("oiio:ColorSpace", space);
    return true;
  }

private:
  /* The most pixels of a picture that is offered in scan lines, and the side of a tile for larger
   * ones. */
  static constexpr uint64_t LARGE = uint64_t(1) << 26;
  static constexpr int TILE = 256;
};

/* Whether the first `size` bytes of a file, at most 64, are the beginning of a format. */
inline bool begins(const std::string &name, size_t size, bool (*is)(const void *, size_t)) {
  unsigned char start[64];
  OIIO::Filesystem::IOFile file(name, OIIO::Filesystem::IOProxy::Read);
  return size <= sizeof start && file.pread(start, size, 0) == size && is(start, size);
}

/* The symbols that the library looks up in a plug-in of this name. */
#define PART_INPUT_PLUGIN(name, Input)                                                             \
  OIIO_PLUGIN_EXPORTS_BEGIN                                                                        \
  OIIO_EXPORT OIIO::ImageInput *name##_input_imageio_create() { return new Input; }                \
  OIIO_EXPORT int name##_imageio_version = OIIO_PLUGIN_VERSION;                                    \
  OIIO_EXPORT const char *name##_imageio_library_version() { return nullptr; }                     \
  OIIO_EXPORT const char *name##_input_extensions[] = {#name, nullptr};                            \
  OIIO_PLUGIN_EXPORTS_END
