/* Frames taken apart by their lights, celspan_stack: what relight.stack in Lua is made of. All answer
 * what they make, or nil and a sentence.
 *
 *   lights in Lua: a list of eight numbers for each, r, g, b, a of its front and of its back; the first
 *   is that of the rostrum itself
 */
#ifndef CS_BIND_STACK_H
#define CS_BIND_STACK_H

#include <lua.h>

/* (rostrum or film, options) -> stack, { cels = {{ name =, has_front = }, ...}, brightness =, width =,
 * height =, bytes = } */
int cs_stack_make(lua_State *L);
/* (stack) -> the lights of the rostrum */
int cs_stack_lights(lua_State *L);
/* (stack, lights) -> image */
int cs_stack_light(lua_State *L);

#endif
