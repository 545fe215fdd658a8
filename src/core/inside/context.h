/* Contexts: memory that is counted, errors with a sentence, and the thread they belong to.
 *
 *     base/context.h     cs_fail and CS_TRY, CS_RESERVE and the allocations of a context keep their
 *                        meaning.
 *     base/error_text.h  A sentence of an error may be taken, and put back with more words.
 *     base/counted.h     A counted value is freed by the last owner, in whatever thread that lets
 *                        it go.
 *     base/mark.h        A mark says where in a script a value was made.
 *     base/tried.h       What was tried and failed is remembered by its name.
 */
#pragma once

#include "base/context.h"
#include "base/counted.h"
#include "base/error_text.h"
#include "base/mark.h"
#include "base/tried.h"
