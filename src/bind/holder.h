/* What C holds while Lua runs, released whatever happens: a call that fails leaves by a long jump,
 * and no C code after it is run.
 *
 *   holder = cs_holder_push(L, "celspan.painting", sizeof *holder, release)
 *   *holder = what was made                     the collector calls release(L) with it as argument 1
 *
 * INVARIANT: a metatable is in the registry whole or not at all, so that one whose making failed
 * for want of memory is made anew. Scripts can neither read nor change it.
 */
#ifndef CS_BIND_HOLDER_H
#define CS_BIND_HOLDER_H

#include <lauxlib.h>

/* Pushes zeroed memory with one user value, whose finaliser is `release`: the same one for all of
 * a kind. Raises an error when out of memory. */
void *cs_holder_push(lua_State *L, const char *kind, size_t size, lua_CFunction release);

/* Keeps the table on top of the stack as the metatable of a kind, closed to scripts, and pops it. */
void cs_holder_keep_metatable(lua_State *L, const char *kind);

#endif
