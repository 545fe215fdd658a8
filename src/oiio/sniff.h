/* What a file is by its first bytes, and how large, before any library sees it.
 *
 * Only the formats named here are read. Those whose readers allocate the whole picture when they
 * are opened have their size read here, so that a lying header is refused first.
 */
#ifndef CS_OIIO_SNIFF_H
#define CS_OIIO_SNIFF_H

#include <string>

#include "oiio/source.h"

struct Sniffed {
  std::string format;     /* the library's name for it */
  bool is_sequential;     /* rows can only be decoded from the top */
  bool is_whole;          /* the reader holds the whole picture in memory */
  uint64_t width, height; /* 0 0: ask the reader */
};

/* Throws Failure, naming what the file is instead, for all others. */
Sniffed sniff(Source &source);

#endif
