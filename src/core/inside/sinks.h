/* What takes rows of spans.
 *
 *   output/sinks/sink.h           rows come whole and in order; after a failure nothing is called
 *                                 but the end
 *   output/sinks/file.h           a file has its name when it is complete, and not before
 *   output/sinks/pixels.h         rows as coded pixels, of any coding
 *   output/sinks/coder.h          the same by the workers, with dithering
 *   output/sinks/ycc_sink.h       pixels as luma and chroma apart, for videos
 *   output/sinks/picture_file.h   files of formats that a picture module writes
 *   output/sinks/strip.h          rows that are made together, as a file of their own
 *   output/sinks/shares.h         a sink that takes rows from several threads
 *   output/sinks/tga.h            the head of a Targa file
 *   output/sinks/ycbcr.h          luma and chroma of a row, as standards define them
 */
#pragma once

#include "output/sinks/coder.h"
#include "output/sinks/file.h"
#include "output/sinks/picture_file.h"
#include "output/sinks/pixels.h"
#include "output/sinks/shares.h"
#include "output/sinks/sink.h"
#include "output/sinks/strip.h"
#include "output/sinks/tga.h"
#include "output/sinks/ycbcr.h"
#include "output/sinks/ycc_sink.h"
