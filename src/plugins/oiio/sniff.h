/* The format of a file by its first bytes, before any library sees it.
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

/* Throws Failure for other files; it names those that are known. */
Sniffed sniff(Source &source);
