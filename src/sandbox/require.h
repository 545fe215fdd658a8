/* require in the sandbox: modules of the script as text, and those of celspan that scripts use. */
#ifndef CS_SANDBOX_REQUIRE_H
#define CS_SANDBOX_REQUIRE_H

#include <lua.h>

/* Pushes the script's require. Libraries of the table at `globals` are modules too. search: where it
 * looks after the script's folder, as templates; NULL: nowhere. */
void cs_require_push(lua_State *L, int globals, const char *search);
/* require for celspan's own modules: nothing but what is built in. */
int cs_require_own(lua_State *L);

#endif
