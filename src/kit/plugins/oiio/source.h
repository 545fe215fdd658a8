/* The bytes of an input file.
 *
 * INVARIANT: the file is opened once, so the library reads the same file that was checked. A reader
 * that keeps reading past the end is stopped by an exception after MISSES reads: some readers never
 * check whether a read succeeded.
 */
#pragma once

#include <OpenImageIO/filesystem.h>
#include <sys/stat.h>

#include <string>
#include <vector>

class Source : public OIIO::Filesystem::IOProxy {
public:
  explicit Source(const char *path);
  ~Source() override;
  const char *proxytype() const override { return "celspan"; }
  void close() override {}
  bool seek(int64_t offset) override;
  size_t read(void *bytes, size_t size) override;
  size_t pread(void *bytes, size_t size, int64_t offset) override;
  size_t size() const override { return size_t(status_.st_size); }

  /* From now on these bytes are read instead of those of the file. */
  void replace(int64_t offset, std::vector<char> bytes);
  /* Must be called before each task: a few reads after the end are allowed again. */
  void forgive() { misses_ = 0; }
  const struct stat &status() const { return status_; }
  /* Whether the path still leads to the same unchanged file. */
  bool is_unchanged() const;

  /* Whether the parts after the first one do not come from the file, but were put into it. */
  bool has_stand_in = false;

private:
  struct Patch {
    int64_t from;
    std::vector<char> bytes;
  };

  size_t copy_ahead(void *bytes, size_t size, int64_t offset);
  size_t read_file(void *bytes, size_t size, int64_t offset);

  std::string path_;
  /* bytes of the file from ahead_at_ on, because some readers ask for only a few at a time */
  std::vector<char> ahead_;
  int64_t ahead_at_ = 0;
  std::vector<Patch> patches_;
  int descriptor_ = -1;
  int misses_ = 0;
  struct stat status_;
};
