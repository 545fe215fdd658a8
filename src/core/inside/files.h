/* Files.
 *
 *   base/open.h                started programs do not inherit files, no call waits for a pipe, and
 *                              interrupted calls are made again
 *   output/sinks/temporary.h   a file that is not finished has a temporary name
 *   output/sinks/file_copy.h   a copy is the file that was measured, or is not made
 */
#pragma once

#include "base/open.h"
#include "output/sinks/file_copy.h"
#include "output/sinks/temporary.h"
