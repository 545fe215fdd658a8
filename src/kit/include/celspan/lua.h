/* celspan for Lua 5.4: for hosts that embed Lua, and the entry points of the loadable module.
 *
 *   celspan_lua_open(L, context)              celspan in a state, under the host's context
 *   celspan_lua_sandbox(L, NULL)             confines scripts of strangers
 *   celspan_lua_run(L, "film.lua", 0, NULL)  a script, which leaves its film on the stack
 *   celspan_film film = CELSPAN_FILM;
 *   celspan_lua_film(L, -1, &film)                   what a script returned
 *   celspan_frame_desc frame = CELSPAN_FRAME_DESC;
 *   celspan_lua_frame(L, -1, film.first, &frame)     a frame of it, to render by the C interface
 *
 * `require "celspan"` then finds the module, and the animation library (celspan.ease, celspan.keys,
 * ...) with it, without any search path. If the library package is open by then, modules that no
 * path of the host has are found beside the file that requires them, as a film wants it. Every Lua
 * state has one context: that of the host, or one of its own, destroyed with the state.
 *
 * No celspan_lua_ function raises, calls the panic function, or changes the stack except as it
 * says: failures come back as a status, with their sentence in the state's context. They are called
 * on the thread that owns the state. Lua's own memory comes from the allocator of the state, all
 * else from the context's.
 */
#ifndef CELSPAN_LUA_H
#define CELSPAN_LUA_H

#include "celspan/film.h"

#ifdef __cplusplus
extern "C" {
#endif

#include <lua.h> /* included here, because it does not declare itself as C */

CELSPAN_API int luaopen_celspan(lua_State *L);

/* Opens celspan as luaL_requiref would. All that scripts make and render then goes through
 * `context`: its memory function, its limits, its last error. context: borrowed until the state is
 * closed, NULL for one of the state's own. It must not be in use by another thread while Lua runs.
 * If celspan is already open in the state, `context` must be the context of the state, or NULL.
 * Errors: BAD_ARGUMENT when the state has another context; NO_MEMORY. The sentence is in
 * `context`. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_lua_open(lua_State *L, celspan_context *context);
/* The context of a state; NULL when celspan was not opened in it, or is closed again: then the
 * other functions return BAD_ARGUMENT, and celspan_context_error of NULL has the sentence. */
CELSPAN_API celspan_context *celspan_lua_context(lua_State *L);

/* The sandbox of the program celspan (docs/sandbox.md), for hosts that load strangers' films: what
 * a script may do, and how much of it. */
typedef struct celspan_lua_limits {
  size_t struct_size;
  /* 0: without limit */
  size_t memory;  /* bytes of Lua and of what the script makes; default: 512 MiB */
  uint64_t steps; /* instructions, and the work of functions, in a run or a frame; 2e9 */
  double seconds; /* processor time of a call, and ten times as much by the clock; 60 */
  size_t print;   /* bytes that may be printed in a run or a frame; 1 MiB */
  /* The files that scripts may read, and the places of modules, in addition to the folder of the
   * script that celspan_lua_run runs. Borrowed only during the call. */
  const char *const *folders; /* NULL: none */
  size_t folder_count;
  const char *search; /* templates of modules, such as "/lib/?.lua;/more/?.lua"; NULL: none */
  /* Receives the text that scripts print, in complete lines. Scripts choose its characters, and a
   * terminal would obey control characters. NULL: the text is dropped. */
  void (*printed)(void *user, const char *text, size_t size);
  /* Called while a script runs. Returns whether the script must end. NULL: no script is
   * interrupted. */
  bool (*is_interrupted)(void *user);
  /* Called on a separate thread if a call still runs one second after its time; only a function of
   * C can do this. May be NULL. The program celspan ends itself in this function. */
  void (*overdue)(void *user, const char *message);
  void *user;
} celspan_lua_limits;

/* The limits of the program. */
CELSPAN_DESCRIPTION(celspan_lua_limits)
#define CELSPAN_LUA_LIMITS (celspan_lua_limits_initial())

/* Confines what runs in the state from now on: its globals are new, with the functions of the
 * sandbox alone, and the methods of strings are the sandbox's. Functions of yours that scripts may
 * call are registered afterwards, as globals. Limits hold in celspan_lua_run, celspan_lua_call and
 * celspan_lua_frame, and for scan-line procedures. Memory is counted in front of the allocator of
 * the state, which must not be changed afterwards. limits: NULL for the defaults. Called after
 * celspan_lua_open, once. Errors: BAD_ARGUMENT; NO_MEMORY, after which the state is of no use. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_lua_sandbox(lua_State *L,
                                                               const celspan_lua_limits *limits);

/* Runs a script, or shows artwork, with the arguments as `...`, and pushes its film. Its folder is
 * the base of relative file names and the first place where `require` looks; a sandbox lets it read
 * there. Errors, with nothing pushed: INPUT when the script cannot be read; CALLBACK when it fails
 * or returns no film; LIMIT; the core's own where the script raised a refusal of the core. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_lua_run(lua_State *L, const char *path,
                                                           int argument_count,
                                                           const char *const *arguments);

/* The same for a script that is a text. name: its path, as messages call it, such as "shots/a.lua"
 * or "-"; no file needs to be there. Errors: those of celspan_lua_run, and BAD_ARGUMENT without a
 * name or a text. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_lua_run_text(lua_State *L, const char *name,
                                                                const char *text, size_t size,
                                                                int argument_count,
                                                                const char *const *arguments);

/* The value of a parameter (celspan.parameters), for the script that is run next: a text as after
 * `--set NAME=` of the program. Of two values for a name the later one holds. A value that the
 * script refuses, or that it has no parameter for, ends it with BAD_ARGUMENT; after celspan_lua_run
 * all values are forgotten. Errors: BAD_ARGUMENT without a name or a value; NO_MEMORY. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_lua_set(lua_State *L, const char *name,
                                                           const char *value);
/* The number of parameters that the script which ran last has declared; and each of them, in the
 * order of their names, from 0. Valid until the next celspan_lua_run. Errors: BAD_ARGUMENT;
 * NO_MEMORY. */
CELSPAN_API size_t celspan_lua_parameter_count(lua_State *L);
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_lua_parameter(lua_State *L, size_t place,
                                                                 celspan_parameter *out);

/* Calls the function below the arguments on the stack, as lua_pcall does, within the limits of the
 * sandbox. On success exactly `result_count` values replace them; otherwise nothing remains.
 * Errors: as for celspan_lua_run. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_lua_call(lua_State *L, int argument_count,
                                                            int result_count);

/* The rostrum at index; NULL for other values. It lives as long as the value in Lua; with
 * celspan_rostrum_ref it lives longer. */
CELSPAN_API celspan_rostrum *celspan_lua_rostrum(lua_State *L, int index);

/* The film at index. A rostrum is a film of one frame, 1920 x 1080, 24 a second, as on the command
 * line. out: begun with CELSPAN_FILM. Errors: BAD_ARGUMENT for anything else, NO_MEMORY. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_lua_film(lua_State *L, int index,
                                                            celspan_film *out);

/* A mark of the film at index, in the order of their frames, from 0. Errors: as above, and
 * BAD_ARGUMENT if the mark does not exist. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_lua_mark(lua_State *L, int index, size_t place,
                                                            celspan_mark *out);
/* Pushes the sounds of the film at index, also those of films that are its sounds, as one value for
 * celspan_lua_sound. count: how many; may be NULL. Files are looked for as the program does, beside
 * the file that made the film. Errors, with nothing pushed: as above; those of celspan_lua_call. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_lua_sounds(lua_State *L, int index,
                                                              size_t *count);
/* One of the sounds at index, from 0. Errors: as for celspan_lua_mark. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_lua_sound(lua_State *L, int index, size_t place,
                                                             celspan_sound *out);

/* Calls the frame function of the film, or takes the rostrum, at index, for a frame's number. out:
 * begun with CELSPAN_FRAME_DESC; new, for celspan_lua_frame_drop: the exposures, and the film's
 * size as that of the film and of the frame; set size, crop, workers and progress as you like and
 * render it by any call that takes a frame. Whatever Lua does meanwhile, its scene lives until it
 * is dropped. Any thread may render it with a context of its own, unless the film uses scan-line
 * procedures, which enter Lua. Errors: BAD_ARGUMENT for a number outside the film or a value that
 * is not one; CALLBACK for an error of the script, "shot.lua:12: frame 37: ..."; the core's own
 * where it refused the scene. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_lua_frame(lua_State *L, int index,
                                                             int64_t number,
                                                             celspan_frame_desc *out);
/* Releases the exposures. Without scan-line procedures, any thread may call it, before or after the
 * state is closed. A desc that is all zero or was dropped may be dropped too. */
CELSPAN_API void celspan_lua_frame_drop(celspan_frame_desc *frame);

#ifdef __cplusplus
}
#endif
#endif
