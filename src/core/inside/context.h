/* Contexts: memory that is counted, and errors with a sentence.
 *
 *   base/context.h      every allocation is counted, and a failure leaves a status and a sentence
 *   base/arrays.h       arrays that a structure owns know their room
 *   base/error_text.h   the sentence of an errno, in any thread
 *   base/counted.h      a value lives until its last reference is dropped, in whatever thread
 *   base/mark.h         a name is valid UTF-8 of a bounded length; marks change no hash and no
 *                       pixel
 *   base/tried.h        the message about a missing file names the other places that were tried
 */
#pragma once

#include "base/arrays.h"
#include "base/context.h"
#include "base/counted.h"
#include "base/error_text.h"
#include "base/mark.h"
#include "base/tried.h"
