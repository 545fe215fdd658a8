/* Hashes of 128 bits.
 *
 *   base/hash.h         equal values have equal hashes in every process and on every machine
 *   base/hash_table.h   what has equal hashes counts as equal
 */
#pragma once

#include "base/hash.h"
#include "base/hash_table.h"
