#include "plugins/oiio/source.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "common/opened.h"
#include "plugins/oiio/shared.h"

/* The number of reads after the end that a correct reader may need in one task. */
static const int MISSES = 1000;
static const size_t AHEAD = 1 << 15;

Source::Source(const char *path) : IOProxy(path, Read), path_(path) {
  descriptor_ = cs_opened_again(path);
  if (descriptor_ < 0)
    throw Failure(CELSPAN_INPUT, std::string("cannot be opened: ") + strerror(errno));
  if (fstat(descriptor_, &status_) != 0 || !S_ISREG(status_.st_mode)) {
    ::close(descriptor_);
    throw Failure(CELSPAN_INPUT, "is not a file; a picture must be one");
  }
}

Source::~Source() { ::close(descriptor_); }

bool Source::seek(int64_t offset) {
  if (offset < 0)
    return false;
  m_pos = offset;
  return true;
}

size_t Source::read(void *bytes, size_t size) {
  size_t got = pread(bytes, size, m_pos);
  m_pos += int64_t(got);
  return got;
}

size_t Source::pread(void *bytes, size_t size, int64_t offset) {
  size_t got = size < AHEAD ? copy_ahead(bytes, size, offset) : read_file(bytes, size, offset);
  if (got < size && ++misses_ > MISSES)
    throw Failure(CELSPAN_INPUT, "is corrupt: its parts lead past its end again and again");
  return got;
}

size_t Source::copy_ahead(void *bytes, size_t size, int64_t offset) {
  if (offset < ahead_at_ || offset + int64_t(size) > ahead_at_ + int64_t(ahead_.size())) {
    std::vector<char> fresh(AHEAD);
    fresh.resize(read_file(fresh.data(), AHEAD, offset));
    ahead_.swap(fresh);
    ahead_at_ = offset;
  }
  size_t got = std::min(size, ahead_.size() - size_t(offset - ahead_at_));
  memcpy(bytes, ahead_.data() + (offset - ahead_at_), got);
  return got;
}

size_t Source::read_file(void *bytes, size_t size, int64_t offset) {
  size_t done = 0;
  while (done < size) {
    ssize_t got = ::pread(descriptor_, static_cast<char *>(bytes) + done, size - done,
                          offset + int64_t(done));
    if (got < 0 && errno == EINTR)
      continue;
    if (got < 0)
      throw Failure(CELSPAN_INPUT, std::string("cannot be read: ") + strerror(errno));
    if (got == 0)
      break;
    done += size_t(got);
  }
  for (const Patch &patch : patches_) {
    int64_t from = std::max(patch.from, offset);
    int64_t to = std::min(patch.from + int64_t(patch.bytes.size()), offset + int64_t(done));
    if (from < to)
      memcpy(static_cast<char *>(bytes) + (from - offset), patch.bytes.data() + (from - patch.from),
             size_t(to - from));
  }
  return done;
}

void Source::replace(int64_t offset, std::vector<char> bytes) {
  patches_.push_back({offset, std::move(bytes)});
  ahead_.clear();
}

bool Source::is_unchanged() const {
  struct stat now;
  bool is_opened = path_.rfind(CS_OPENED, 0) == 0;
  int found = is_opened ? fstat(descriptor_, &now) : stat(path_.c_str(), &now);
  return found == 0 && now.st_size == status_.st_size && now.st_ino == status_.st_ino &&
         now.st_mtim.tv_sec == status_.st_mtim.tv_sec &&
         now.st_mtim.tv_nsec == status_.st_mtim.tv_nsec;
}
