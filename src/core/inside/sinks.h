/* What takes rows of spans.
 *
 *     output/sinks/file.h          A file that gets its rows in order.
 *     output/sinks/pixels.h        Codings of pixels.
 *     output/sinks/sink.h          The functions of a sink.
 *     output/sinks/picture_file.h  Files that a module writes.
 *     output/sinks/coder.h         Rows of spans become bytes.
 *     output/sinks/strip.h         Rows that are made together.
 *     output/sinks/tga.h           The head of Targa.
 *     output/sinks/shares.h        Shares of channels.
 *     output/sinks/ycbcr.h         Luma and chroma.
 */
#pragma once

#include "output/sinks/coder.h"
#include "output/sinks/file.h"
#include "output/sinks/picture_file.h"
#include "output/sinks/pixels.h"
#include "output/sinks/planes_sink.h"
#include "output/sinks/shares.h"
#include "output/sinks/sink.h"
#include "output/sinks/strip.h"
#include "output/sinks/tga.h"
#include "output/sinks/ycbcr.h"
