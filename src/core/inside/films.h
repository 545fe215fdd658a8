/* Films.
 *
 *     frames/film/film.h      What a film says of itself.
 *     frames/film/sequence.h  Names and numbers of frames.
 *     frames/film/shoot.h     Frames are reported in order.
 */
#pragma once

#include "frames/film/film.h"
#include "frames/film/sequence.h"
#include "frames/film/shoot.h"
#include "frames/film/slots.h"
