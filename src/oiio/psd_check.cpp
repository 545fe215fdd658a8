#include "oiio/psd_check.h"

#include "oiio/shared.h"

namespace {

enum {
  HEADER = 26,
  HEADER_CHANNELS = 12, /* the places of numbers in it */
  HEADER_MODE = 24,
  BITMAP = 0, /* a mode, of black and white alone */
  LARGE = 2,
  USER_MASK = -2,
  WHOLE_MASK = -3,
  CHANNELS = 56,
  OLD_THUMBNAIL = 1033, /* the numbers of resources; 0 is that of none */
  THUMBNAIL = 1036,
  THUMBNAILS = 16 /* of which the programs that write documents write one */
};

/* Big-endian numbers, one after the other; 0 from the end of the file on. */
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

/* The length of what follows, in four bytes. OpenImageIO takes memory for all of it before it reads the first byte. */
uint64_t length_of(Source &source, Numbers &numbers) {
  uint64_t length = numbers.next(4);
  if (length > source.size())
    throw Failure(CELSPAN_INPUT, "is damaged: a part of it is longer than the file");
  return length;
}

/* Resources: a signature, a number, a name, the length of the data, the data; name and data have an
 * even number of bytes. numbers: at the first one; a copy, for a wrong length leads anywhere. */
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

/* Whether the document has a channel beside those of its colours; throws Failure where it lacks one of
 * them. */
bool has_transparency(Source &source) {
  static const uint64_t colours[] = {1, 1, 1, 3, 4,
                                     0, 0, 1, 1, 3}; /* by the mode; 0: there is none */
  uint64_t channels = Numbers(source, HEADER_CHANNELS).next(2);
  uint64_t mode = Numbers(source, HEADER_MODE).next(2);
  bool is_known = mode < sizeof colours / sizeof *colours;
  if (is_known && channels < colours[mode])
    throw Failure(CELSPAN_INPUT, "is damaged: it lacks channels of its colours");
  return is_known && mode != BITMAP && channels > colours[mode];
}

/* The rows of a rectangle; the numbers are left behind it. */
uint64_t rows_of(Numbers &numbers) {
  int64_t top = numbers.place();
  numbers.skip(4);
  int64_t bottom = numbers.place();
  numbers.skip(4);
  return uint64_t(bottom > top ? bottom - top : top - bottom);
}

/* The rows of all channels of the record at the numbers, which are left behind it. A channel of two
 * bytes has but the number of its packing, and no rows. */
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

} // namespace

void check_psd(Source &source) {
  bool is_transparent = has_transparency(source);
  Numbers numbers(source, 4);
  int length_bytes = numbers.next(2) == LARGE ? 8 : 4;
  numbers.skip(HEADER - 6);
  numbers.skip(length_of(source, numbers)); /* the colour table */
  uint64_t resources = length_of(source, numbers);
  hide_thumbnails(source, numbers, resources);
  numbers.skip(resources);
  uint64_t section = numbers.next(length_bytes), list = numbers.next(length_bytes), rows = 0;
  if (section == 0 || list == 0)
    return;
  uint64_t at = numbers.at();
  int number = int16_t(uint16_t(numbers.next(2))), count = number < 0 ? -number : number;
  if (number < 0 && !is_transparent)
    source.replace(int64_t(at), {char(count >> 8), char(count)});
  for (int i = 0; i < count && !numbers.is_over(); i++) {
    rows += rows_of_record(numbers, length_bytes);
    if (rows > source.size())
      throw Failure(CELSPAN_INPUT, "is damaged: its layers tell of more rows than it has bytes");
  }
}
