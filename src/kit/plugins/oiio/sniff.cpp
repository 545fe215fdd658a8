#include "plugins/oiio/sniff.h"

#include <cstring>

#include "plugins/oiio/shared.h"

namespace {

const size_t HEAD = 4096;

struct Head {
  unsigned char bytes[HEAD];
  size_t size;

  bool starts(const char *magic, size_t length, size_t at = 0) const {
    return size >= at + length && memcmp(bytes + at, magic, length) == 0;
  }
  uint64_t big(size_t at) const {
    return uint64_t(bytes[at]) << 24 | bytes[at + 1] << 16 | bytes[at + 2] << 8 | bytes[at + 3];
  }
  uint64_t little16(size_t at) const { return uint64_t(bytes[at]) | uint64_t(bytes[at + 1]) << 8; }
};

struct Magic {
  const char *format, *bytes;
  size_t length, at;
  bool is_sequential, is_whole;
};

const Magic magics[] = {
    {"png", "\x89PNG\r\n\x1a\n", 8, 0, true, false},
    {"tiff", "II*\0", 4, 0, false, false},
    {"tiff", "MM\0*", 4, 0, false, false},
    {"tiff", "II+\0", 4, 0, false, false},
    {"tiff", "MM\0+", 4, 0, false, false},
    {"openexr", "\x76\x2f\x31\x01", 4, 0, false, false},
    {"jpeg", "\xff\xd8\xff", 3, 0, true, false},
    {"dpx", "SDPX", 4, 0, false, false},
    {"dpx", "XPDS", 4, 0, false, false},
    {"cineon", "\x80\x2a\x5f\xd7", 4, 0, false, false},
    {"cineon", "\xd7\x5f\x2a\x80", 4, 0, false, false},
    {"psd", "8BPS", 4, 0, false, true},
    {"webp", "WEBP", 4, 8, false, true},
    {"gif", "GIF87a", 6, 0, false, true},
    {"gif", "GIF89a", 6, 0, false, true},
    {"hdr", "#?RADIANCE", 10, 0, true, false},
    {"hdr", "#?RGBE", 6, 0, true, false},
    {"jpeg2000", "\0\0\0\x0cjP  \r\n\x87\n", 12, 0, false, true},
    {"jpeg2000", "\xff\x4f\xff\x51", 4, 0, false, true},
    {"sgi", "\x01\xda", 2, 0, false, false},
    {"bmp", "BM", 2, 0, false, false},
    {"pnm", "P1", 2, 0, true, true},
    {"pnm", "P2", 2, 0, true, true},
    {"pnm", "P3", 2, 0, true, true},
    {"pnm", "P4", 2, 0, true, true},
    {"pnm", "P5", 2, 0, true, true},
    {"pnm", "P6", 2, 0, true, true},
    {"pnm", "Pf", 2, 0, true, true},
    {"pnm", "PF", 2, 0, true, true},
};

#define DRAWING " as a picture; celspan.svg reads SVG drawings"
#define MOVIE "; 'ffmpeg -i clip.mp4 clip.%04d.png' makes pictures of one, clip.####.png"

/* Files that were given by mistake, or whose readers cannot be trusted. */
const struct {
  const char *bytes;
  size_t length, at;
  const char *name, *advice;
} refused[] = {
    {"FOR4", 4, 0, "an IFF picture", ""},
    {"SIMPLE", 6, 0, "a FITS picture", ""},
    {"DDS ", 4, 0, "a DDS picture", ""},
    {"\0\0\1\0", 4, 0, "an icon", ""},
    {"%PDF", 4, 0, "a PDF document", ""},
    {"<svg", 4, 0, "an SVG drawing", DRAWING},
    {"<?xml", 5, 0, "an XML text", DRAWING},
    {"PK\3\4", 4, 0, "a zip archive", ""},
    {"#!", 2, 0, "a script", ""},
    {"\x1c\0\xc5", 3, 0, "a span file", ""},
    {"ftypavif", 8, 4, "an AVIF picture", ""},
    {"ftyphei", 7, 4, "a HEIF picture", ""},
    {"ftypmif1", 8, 4, "a HEIF picture", ""},
    {"ftyp", 4, 4, "a movie", MOVIE},
    {"moov", 4, 4, "a movie", MOVIE},
    {"\x1a\x45\xdf\xa3", 4, 0, "a movie", MOVIE},
    {"AVI ", 4, 8, "a movie", MOVIE},
    {"\0\0\1\xba", 4, 0, "a movie", MOVIE},
};

/* Targa has no magic number, so all fields of the header must be plausible (formats, TGA 2.0). */
bool is_targa(const Head &head) {
  if (head.size < 18)
    return false;
  unsigned map = head.bytes[1], type = head.bytes[2], bits = head.bytes[16];
  bool has_known_type =
      type == 1 || type == 2 || type == 3 || type == 9 || type == 10 || type == 11;
  bool has_map = type == 1 || type == 9;
  bool has_known_bits = bits == 8 || bits == 15 || bits == 16 || bits == 24 || bits == 32;
  return has_known_type && has_known_bits && map <= 1 && (!has_map || map == 1) &&
         (head.bytes[17] & 0xc0) == 0 && head.little16(12) > 0 && head.little16(14) > 0;
}

void read_size(const Head &head, Sniffed *found) {
  const std::string &format = found->format;
  if (format == "gif" && head.size >= 10) {
    found->width = head.little16(6);
    found->height = head.little16(8);
  } else if (format == "psd" && head.size >= 22) {
    found->height = head.big(14);
    found->width = head.big(18);
  } else if (format == "targa") {
    found->width = head.little16(12);
    found->height = head.little16(14);
  } else if (format == "jpeg2000") {
    for (size_t i = 0; i + 12 <= head.size; i++)
      if (memcmp(head.bytes + i, "\xff\x4f\xff\x51", 4) == 0 && i + 24 <= head.size) {
        uint64_t right = head.big(i + 8), bottom = head.big(i + 12);
        uint64_t left = head.big(i + 16), top = head.big(i + 20);
        found->width = right > left ? right - left : 0;
        found->height = bottom > top ? bottom - top : 0;
        return;
      }
  }
}

} // namespace

Sniffed sniff(Source &source) {
  Head head;
  head.size = source.pread(head.bytes, HEAD, 0);
  if (head.size == 0)
    throw Failure(CELSPAN_INPUT, "is empty");
  for (const Magic &magic : magics)
    if (head.starts(magic.bytes, magic.length, magic.at)) {
      Sniffed found = {magic.format, magic.is_sequential, magic.is_whole, 0, 0};
      read_size(head, &found);
      return found;
    }
  for (const auto &other : refused)
    if (head.starts(other.bytes, other.length, other.at))
      throw Failure(CELSPAN_INPUT,
                    std::string("is ") + other.name + ", which is not read" + other.advice);
  if (!is_targa(head))
    throw Failure(
        CELSPAN_INPUT,
        "is not a picture of a known format (png, tiff, openexr, jpeg, targa, dpx, cineon, "
        "psd, bmp, webp, gif, hdr, pnm, jpeg2000, sgi)");
  Sniffed found = {"targa", false, true, 0, 0};
  read_size(head, &found);
  return found;
}
