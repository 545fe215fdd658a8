/* What is found in a file before any library sees it: its format, by its first bytes, and damage.
 *
 * INVARIANT: only formats named in sniff.cpp are read. Where the reader of a format allocates the
 * whole picture when it is opened, the size is found here, so that a header with an absurd size is
 * refused first.
 */
#pragma once

#include <string>

#include "plugins/oiio/source.h"

struct Sniffed {
  std::string format;     /* by the library's name */
  bool is_sequential;     /* rows can only be decoded from the top */
  bool is_whole;          /* the reader holds the whole picture in memory */
  uint64_t width, height; /* 0 0: ask the reader */
};

/* Throws Failure for other files, with the names of the known formats. */
Sniffed sniff(Source &source);

/* To be called before the library opens the file. format: by the library's name. Throws Failure for
 * a damaged file that the library's readers would not report, or for which they would allocate far
 * more memory than the file has bytes. It also hides parts of the file that the library should not
 * read. No file that is complete and undamaged is refused. */
void check_file(Source &source, const std::string &format);
