/* Hashes.
 *
 *     base/hash.h        The hash of equal bytes is equal in all versions.
 *     base/hash_table.h  Keys are of 128 bits; they are not looked at again.
 */
#pragma once

#include "base/hash.h"
#include "base/hash_table.h"
