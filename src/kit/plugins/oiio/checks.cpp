/* Damaged files, and files that ask for far more memory than they have bytes. */
#include "plugins/oiio/sniff.h"

#include <algorithm>
#include <cstring>
#include <vector>

#include "plugins/oiio/shared.h"

namespace {

/* ---------------------------------------------------------------- JPEG */

/* A JPEG is a sequence of markers (ISO/IEC 10918-1, B.1.1), each 0xff and a code:
 *
 *   SOI  APP1 length, bytes  DQT ..  SOF ..  SOS length, bytes, coded  SOS ..  EOI  whatever
 *             \________________/                               \___/
 *               may contain a                    ff 00 is a byte ff of the data, ff d0 .. ff d7
 *               thumbnail                        are restarts; any other marker ends the scan
 *
 * A marker may have several ff before it, and bytes between segments are skipped, as the library
 * does. A progressive picture has many scans. Only the end marker of the picture itself counts:
 * those of thumbnails lie inside segments, which are skipped by their lengths; those of further
 * pictures, as phones append them, lie behind it. */
enum Code { TEM = 0x01, RST0 = 0xd0, SOI = 0xd8, EOI = 0xd9 };

/* The bytes of the file in order. After its end there are no more. */
class Bytes {
public:
  explicit Bytes(Source &source) : source_(source), left_(source.size()) {}

  /* -1: the file has ended. */
  int next() {
    if (at_ == size_ && !fill())
      return -1;
    return buffer_[at_++];
  }
  /* Skips to the byte after the next byte of this value; false: there is none. */
  bool find(int value) {
    while (at_ < size_ || fill()) {
      const void *found = memchr(buffer_.data() + at_, value, size_ - at_);
      if (found) {
        at_ = size_t(static_cast<const unsigned char *>(found) - buffer_.data()) + 1;
        return true;
      }
      at_ = size_;
    }
    return false;
  }
  bool skip(uint64_t count) {
    uint64_t buffered = size_ - at_;
    if (count <= buffered) {
      at_ += size_t(count);
      return true;
    }
    if (count - buffered > left_)
      return false;
    left_ -= count - buffered;
    at_ = size_;
    return true;
  }

private:
  bool fill() {
    at_ = size_ = 0;
    if (left_ == 0)
      return false;
    buffer_.resize(size_t(std::min<uint64_t>(left_, uint64_t(1) << 16)));
    size_ = source_.pread(buffer_.data(), buffer_.size(), int64_t(source_.size() - left_));
    left_ -= size_;
    return size_ > 0;
  }

  Source &source_;
  uint64_t left_; /* bytes of the file after those in the buffer */
  std::vector<unsigned char> buffer_;
  size_t at_ = 0, size_ = 0;
};

/* The code of the next marker; -1: there is none. */
int next_marker(Bytes &bytes) {
  while (bytes.find(0xff)) {
    int code = bytes.next();
    while (code == 0xff)
      code = bytes.next();
    if (code != 0)
      return code;
  }
  return -1;
}

bool has_body(int code) { return code != TEM && (code < RST0 || code > EOI); }

bool skip_body(Bytes &bytes) {
  int high = bytes.next(), low = bytes.next();
  if (high < 0 || low < 0)
    return false;
  int length = high << 8 | low;
  return length >= 2 && bytes.skip(uint64_t(length - 2));
}

/* Without this check, the library would fill a missing part with grey and report success. */
void check_jpeg_end(Source &source) {
  Bytes bytes(source);
  bool has_begun = false;
  for (int code = next_marker(bytes); code >= 0; code = next_marker(bytes)) {
    if (code == EOI)
      return;
    if (code == SOI && has_begun) /* another picture begins, but the first one has not ended */
      break;
    has_begun = true;
    if (has_body(code) && !skip_body(bytes))
      break;
  }
  throw Failure(CELSPAN_INPUT, "is truncated: the end of the picture is missing");
}

/* ---------------------------------------------------------------- Photoshop */

/* When a Photoshop document is opened, its reader allocates some bytes for each row of each channel
 * of each layer, by the rectangles of the records, before it looks for the rows; and it decodes the
 * thumbnail, a JPEG file among the resources, whatever its size. It reads the channels of the
 * mode's colours, and where the number of layers is below 0 one of transparency, whatever their
 * number. For the colour table and for each resource it allocates as much memory as their length
 * says.
 *
 * So no part before the layers may be longer than the file, and the layers may have at most as many
 * rows as the file has bytes: a row that is stored has a byte or more. Thumbnails, which nobody
 * uses, are hidden from the reader, and so is the sign of that number where the document has only
 * the channels of its colours. A document that is cut off is left to the reader, which reads the
 * records first. */
enum {
  HEADER = 26,
  HEADER_CHANNELS = 12, /* indices of numbers in the header */
  HEADER_MODE = 24,
  BITMAP = 0, /* a mode, of black and white alone */
  LARGE = 2,
  USER_MASK = -2,
  WHOLE_MASK = -3,
  CHANNELS = 56,
  OLD_THUMBNAIL = 1033, /* numbers of resources; 0 is not used */
  THUMBNAIL = 1036,
  THUMBNAILS = 16 /* the most thumbnails; programs write only one */
};

/* Big-endian numbers, one after the other; after the end of the file they are 0. */
class Numbers {
public:
  Numbers(Source &source, uint64_t at) : source_(source), at_(at) {}

  uint64_t next(int bytes) {
    unsigned char found[8] = {0};
    uint64_t number = 0;
    is_over_ = is_over() || source_.pread(found, size_t(bytes), int64_t(at_)) < size_t(bytes);
    at_ += uint64_t(bytes);
    for (int i = 0; i < bytes && !is_over_; i++)
      number = number << 8 | found[i];
    return number;
  }
  int32_t place() { return int32_t(uint32_t(next(4))); }
  void skip(uint64_t bytes) {
    is_over_ = is_over_ || bytes > source_.size();
    at_ += is_over_ ? 0 : bytes;
  }
  uint64_t at() const { return at_; }
  bool is_over() const { return is_over_ || at_ > source_.size(); }

private:
  Source &source_;
  uint64_t at_;
  bool is_over_ = false;
};

/* The length of the part that follows, in four bytes. OpenImageIO allocates memory for the whole
 * part before it reads the first byte. */
uint64_t length_of(Source &source, Numbers &numbers) {
  uint64_t length = numbers.next(4);
  if (length > source.size())
    throw Failure(CELSPAN_INPUT, "is damaged: a part of it is longer than the file");
  return length;
}

/* Resources: a signature, a number, a name, the length of the data, the data; name and data have an
 * even number of bytes. numbers: at the first resource; a copy, because a wrong length could lead
 * anywhere. */
void hide_thumbnails(Source &source, Numbers numbers, uint64_t size) {
  uint64_t end = numbers.at() + size;
  for (int hidden = 0; numbers.at() < end && !numbers.is_over();) {
    numbers.skip(4);
    uint64_t at = numbers.at(), number = numbers.next(2);
    numbers.skip(numbers.next(1) | 1);
    uint64_t length = length_of(source, numbers);
    numbers.skip(length + (length & 1));
    if (number != THUMBNAIL && number != OLD_THUMBNAIL)
      continue;
    if (++hidden > THUMBNAILS)
      throw Failure(CELSPAN_INPUT, "is damaged: it has more than 16 thumbnails");
    source.replace(int64_t(at), {0, 0});
  }
}

/* Whether the document has a channel in addition to its colours. Throws Failure if a
 * channel of its colours is missing. */
bool has_transparency(Source &source) {
  static const uint64_t colours[] = {1, 1, 1, 3, 4,
                                     0, 0, 1, 1, 3}; /* by the mode; 0: the mode does not exist */
  uint64_t channels = Numbers(source, HEADER_CHANNELS).next(2);
  uint64_t mode = Numbers(source, HEADER_MODE).next(2);
  bool is_known = mode < sizeof colours / sizeof *colours;
  if (is_known && channels < colours[mode])
    throw Failure(CELSPAN_INPUT, "is damaged: it lacks channels of its colours");
  return is_known && mode != BITMAP && channels > colours[mode];
}

/* The rows of a rectangle. The numbers are moved to its end. */
uint64_t rows_of(Numbers &numbers) {
  int64_t top = numbers.place();
  numbers.skip(4);
  int64_t bottom = numbers.place();
  numbers.skip(4);
  return uint64_t(bottom > top ? bottom - top : top - bottom);
}

/* The rows of all channels of the record at `numbers`, which are moved to its end. A channel of two
 * bytes has only the number of its packing, and no rows. */
uint64_t rows_of_record(Numbers &numbers, int length_bytes) {
  uint64_t rows = rows_of(numbers), count = numbers.next(2), mask_rows = 0;
  uint64_t colours = 0, masks = 0;
  if (count > CHANNELS)
    throw Failure(CELSPAN_INPUT, "is damaged: a layer has more than 56 channels");
  for (uint64_t i = 0; i < count; i++) {
    int id = int16_t(uint16_t(numbers.next(2)));
    bool has_rows = numbers.next(length_bytes) > 2, is_mask = id == USER_MASK || id == WHOLE_MASK;
    colours += has_rows && !is_mask;
    masks += has_rows && is_mask;
  }
  numbers.skip(4 + 4 + 4); /* signature, blend mode, opacity and flags */
  uint64_t extra = numbers.next(4), start = numbers.at();
  if (numbers.next(4) >= 16)
    mask_rows = rows_of(numbers);
  numbers.skip(start + extra > numbers.at() ? start + extra - numbers.at() : 0);
  return rows * colours + mask_rows * masks;
}

/* Whether the layers of 16 or 32 bits say that the merged picture has alpha. They are in a block
 * behind the list of layers of 8 bits, which is empty. numbers: behind that list, in a part that
 * ends at `end`. */
bool has_deep_transparency(Numbers numbers, uint64_t end, int length_bytes) {
  const uint64_t block = 0x3842494d, deep16 = 0x4c723136, deep32 = 0x4c723332; /* 8BIM, Lr16, .. */
  numbers.skip(numbers.next(4)); /* the masks of all layers */
  while (numbers.at() < end && !numbers.is_over() && numbers.next(4) == block) {
    uint64_t name = numbers.next(4);
    bool is_list = name == deep16 || name == deep32;
    uint64_t length = numbers.next(is_list ? length_bytes : 4);
    if (is_list)
      return int16_t(uint16_t(numbers.next(2))) < 0;
    numbers.skip((length + 3) / 4 * 4);
  }
  return false;
}

/* The library asks the list of layers of 8 bits alone whether the merged picture has alpha, and
 * then needs no block after it. So a list with one layer of no pixels replaces them all. at: of
 * the length of the list. size: of the length and all after it. */
void show_transparency(Source &source, uint64_t at, uint64_t size, int length_bytes) {
  static const char list[] = "\xff\xff"                         /* one layer, and there is alpha */
                             "\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0" /* its rectangle */
                             "\0\0"                             /* channels */
                             "8BIMnorm\xff\0\0\0"
                             "\0\0\0\x0c\0\0\0\0\0\0\0\0\0\0\0"; /* no mask, no name */
  std::vector<char> bytes;
  if (size < uint64_t(length_bytes) + sizeof list)
    return;
  for (int i = length_bytes - 1; i >= 0; i--)
    bytes.push_back(char((size - uint64_t(length_bytes)) >> 8 * i));
  bytes.insert(bytes.end(), list, list + sizeof list);
  source.replace(int64_t(at), std::move(bytes));
  source.has_stand_in = true;
}

void check_psd(Source &source) {
  bool is_transparent = has_transparency(source);
  Numbers numbers(source, 4);
  int length_bytes = numbers.next(2) == LARGE ? 8 : 4;
  numbers.skip(HEADER - 6);
  numbers.skip(length_of(source, numbers)); /* the colour table */
  uint64_t resources = length_of(source, numbers);
  hide_thumbnails(source, numbers, resources);
  numbers.skip(resources);
  uint64_t section = numbers.next(length_bytes), start = numbers.at();
  uint64_t list = numbers.next(length_bytes), rows = 0;
  if (section > 0 && list == 0 && is_transparent &&
      has_deep_transparency(numbers, start + section, length_bytes))
    show_transparency(source, start, section, length_bytes);
  if (section == 0 || list == 0)
    return;
  uint64_t at = numbers.at();
  int number = int16_t(uint16_t(numbers.next(2))), count = number < 0 ? -number : number;
  if (number < 0 && !is_transparent)
    source.replace(int64_t(at), {char(count >> 8), char(count)});
  for (int i = 0; i < count && !numbers.is_over(); i++) {
    rows += rows_of_record(numbers, length_bytes);
    if (rows > source.size())
      throw Failure(CELSPAN_INPUT, "is damaged: its layers have more rows than the file has bytes");
  }
}

/* ---------------------------------------------------------------- film and SGI */

/* The readers of film formats return black for missing pixels. The header contains the size of the
 * file; in DPX also the size of the data for other programs, for which the reader allocates memory
 * before it checks whether they exist. */
void check_film_end(Source &source, const std::string &format) {
  unsigned char head[36] = {0};
  source.pread(head, sizeof head, 0);
  bool is_big = head[0] == 'S' || head[0] == 0x80, is_dpx = format == "dpx";
  auto number_at = [&](int place) {
    uint64_t number = 0;
    for (int i = 0; i < 4; i++)
      number = number << 8 | head[place + (is_big ? i : 3 - i)];
    return number == 0xffffffff ? 0 : number; /* all ones: not specified */
  };
  uint64_t size = number_at(is_dpx ? 16 : 20);
  if (source.size() < size)
    throw Failure(CELSPAN_INPUT, "is truncated: it has " + std::to_string(source.size()) +
                                     " of the " + std::to_string(size) +
                                     " bytes that its header declares");
  if (is_dpx && source.size() < number_at(32))
    throw Failure(CELSPAN_INPUT,
                  "is damaged: its header declares more user data than the file has bytes");
}

/* If rows are packed, the header is followed by two tables of four bytes for each row of each
 * channel, for which the reader allocates memory before it reads them. If rows are stored in an
 * unknown way, the reader allocates no tables, but uses them (SGI image file format, 1.00). */
void check_sgi(Source &source) {
  const uint64_t header = 512, packed = 1;
  unsigned char head[12] = {0};
  source.pread(head, sizeof head, 0);
  uint64_t rows = uint64_t(head[8]) << 8 | head[9], channels = uint64_t(head[10]) << 8 | head[11];
  if (head[2] > packed)
    throw Failure(CELSPAN_INPUT, "is damaged: its rows are stored in an unknown way");
  if (head[2] == packed && source.size() < header + 2 * 4 * rows * channels)
    throw Failure(CELSPAN_INPUT,
                  "is damaged: its header declares more rows than the file has bytes");
}

} // namespace

void check_file(Source &source, const std::string &format) {
  if (format == "jpeg")
    check_jpeg_end(source);
  if (format == "psd")
    check_psd(source);
  if (format == "dpx" || format == "cineon")
    check_film_end(source, format);
  if (format == "sgi")
    check_sgi(source);
}
