/* Random numbers as pure functions of a seed and a label: FNV-1a over the bytes, then SplitMix64's
 * finaliser. The same on every machine. */
#pragma once

#include <lua.h>
#include <stddef.h>
#include <stdint.h>

extern const uint64_t cs_random_begin; /* the hash of an empty text */
uint64_t cs_random_bytes(uint64_t hash, const char *bytes, size_t size);
uint64_t cs_random_integer(uint64_t hash, uint64_t number);

/* Pushes random(label [, m [, n]]) of the arguments from `first` on: 0 <= x < 1, or a whole number
 * 1..m, or m..n. */
int cs_random_push(lua_State *L, uint64_t seed, int first);

/* celspan.random(seed) */
int cs_random_make(lua_State *L);
