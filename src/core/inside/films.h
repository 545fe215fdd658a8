/* Films.
 *
 *   frames/film/film.h       what a film says of itself; its frames are built in order by one
 *                            thread
 *   frames/film/sequence.h   one grammar of lists of frames and of their names
 *   frames/film/shoot.h      frames are reported in their order, whatever the number of workers
 *   frames/film/slots.h      whole frames ahead of the one that is given on next
 */
#pragma once

#include "frames/film/film.h"
#include "frames/film/sequence.h"
#include "frames/film/shoot.h"
#include "frames/film/slots.h"
