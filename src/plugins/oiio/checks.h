/* Files that the library's readers would not report as damaged, or that make them allocate far more
 * memory than the file has bytes.
 *
 * INVARIANT: no file that is complete and undamaged is refused.
 */
#pragma once

#include "plugins/oiio/source.h"

/* To be called before the library opens the file. format: by the library's name. Throws Failure for
 * a damaged file, and hides from the reader parts that it should not read. */
void check_file(Source &source, const std::string &format);
