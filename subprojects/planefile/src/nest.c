/* The head of a nest: where its planes are, and where they are shown. */
#include "nest.h"

const char *pf_nest_begin(const unsigned char start[PF_NEST_BYTES], uint64_t file_size,
                          size_t *size) {
  uint32_t planes = pf_load_32(start + 12), windows = pf_load_32(start + 16);
  if (pf_load_32(start + 8) != PF_NEST_VERSION)
    return "the nest of planes has another version";
  if (planes == 0 || planes > PF_NEST_MOST || windows > PF_NEST_MOST)
    return "a nest has 1 to 1024 planes and at most 1024 windows";
  *size = PF_NEST_BYTES + (size_t)PF_SIZE_BYTES * planes + (size_t)PF_WINDOW_BYTES * windows +
          PF_CHECK_BYTES;
  return *size <= file_size ? NULL : "the file is too short for the head of its nest";
}

static bool is_window(const unsigned char *window, uint32_t planes) {
  double least = 1.0 / PF_WINDOW_PART;
  double left = pf_load_double(window), top = pf_load_double(window + 8);
  double right = pf_load_double(window + 16), foot = pf_load_double(window + 24);
  uint32_t plane = pf_load_32(window + 32);
  return left >= 0 && right <= 1 && right - left >= least && top >= 0 && foot <= 1 &&
         foot - top >= least && plane > 0 && plane < planes;
}

const char *pf_nest_check(const unsigned char *head, size_t size, uint64_t file_size,
                          uint64_t *ends) {
  uint32_t planes = pf_load_32(head + 12), windows = pf_load_32(head + 16);
  const unsigned char *sizes = head + PF_NEST_BYTES, *window = sizes;
  uint64_t at = size;
  if (pf_load_32(head + size - PF_CHECK_BYTES) != pf_crc32c(0, head, size - PF_CHECK_BYTES))
    return "the checksum of the head of the nest is wrong";
  for (uint32_t i = 0; i < planes; i++, window += PF_SIZE_BYTES) {
    uint64_t bytes = pf_load_64(window);
    if (bytes > file_size - at)
      return "the planes of the nest are larger than the file";
    ends[i] = at += bytes;
  }
  for (uint32_t i = 0; i < windows; i++, window += PF_WINDOW_BYTES)
    if (!is_window(window, planes))
      return "the nest has a window that is not allowed";
  return at == file_size ? NULL : "there is something after the nest";
}
