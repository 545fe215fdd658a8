/* A JPEG is a row of markers (ISO/IEC 10918-1, B.1.1), each 0xff and a code:
 *
 *   SOI  APP1 length, bytes  DQT ..  SOF ..  SOS length, bytes, coded  SOS ..  EOI  whatever
 *             \________________/                               \___/
 *               a thumbnail may                  ff 00 is a byte ff of the data, ff d0 .. ff d7
 *               be in there                      are restarts; any other marker ends the scan
 *
 * A marker may have several ff before it, and what stands between segments is passed over, as the
 * library does. A progressive picture has many scans.
 */
#include "oiio/jpeg_end.h"

#include <algorithm>
#include <cstring>
#include <vector>

#include "oiio/shared.h"

namespace {

enum Code { TEM = 0x01, RST0 = 0xd0, SOI = 0xd8, EOI = 0xd9 };

/* The file's bytes in order; beyond its end there are none. */
class Bytes {
public:
  explicit Bytes(Source &source) : source_(source), left_(source.size()) {}

  /* -1: the file ends here. */
  int next() {
    if (at_ == size_ && !fill())
      return -1;
    return buffer_[at_++];
  }
  /* Goes on behind the next byte of this value; false: there is none. */
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
  uint64_t left_; /* bytes of the file that are not in the buffer and not before it */
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

} // namespace

void check_jpeg_end(Source &source) {
  Bytes bytes(source);
  bool has_begun = false;
  for (int code = next_marker(bytes); code >= 0; code = next_marker(bytes)) {
    if (code == EOI)
      return;
    if (code == SOI && has_begun) /* another picture, and the first has not ended */
      break;
    has_begun = true;
    if (has_body(code) && !skip_body(bytes))
      break;
  }
  throw Failure(CELSPAN_INPUT, "is truncated: the end of the picture is missing");
}
