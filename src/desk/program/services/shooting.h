/* Methods of script_service.c for the frames of a film: into files, digests, or one file or stream.
 *
 *   target (a row of outputs.c) --> shoot (frames/film/shoot.h: build, make, copy) --> finished
 *
 * Which frames these are, which of them are kept, and what is reported of them is decided in Lua
 * (verbs/render.lua). Its functions are called by the thread that builds the frames, in order. An
 * error that they raise ends the run, and is raised again when the run has ended.
 */
#pragma once

#include <lua.h>

#include "program/film/script.h"

/* script:target(path or nil, count) -> { row =, outlet =, holds_all =, is_video = } for
 * script:shoot, and of a video { format =, captions_form =, poster = "attached" or "beside",
 * runs_ffmpeg = }. Ends the verb if that many frames cannot be written there. */
int cs_shooting_target(lua_State *L, const cs_script *script);
/* script:shoot{ row =, outlet =, path =, numbers =, played =, chapters =, captions =, keep =,
 * finished = } -> the exit code of the run, whose failure is reported; the bytes and the hash of
 * the file of an outlet.
 *
 *   keep(number, path, scene, inputs)   -> whether the file of the frame is kept, whether it shows
 *                                       the same, its digest; scene: nil where a procedure draws
 *   finished(number, code, how, seconds, bytes, contents, digest)
 *                                       -> nil; 0: the frame failed, and the run continues; or the
 *                                       exit code of the run, which ends. code: 0, or the exit
 *                                       code of the frame, which has failed and is reported. how:
 *                                       "made", "copied" or "kept"
 *
 * Hashes and digests are texts of hexadecimal digits. Without `finished`, frames are only built for
 * `keep`, and nothing is reported. */
int cs_shooting_run(lua_State *L, cs_script *script);
/* script:write_poster(path) -> the exit code: writes the frame that stands for the film. */
int cs_shooting_poster(lua_State *L, cs_script *script);
/* script:key(has_view) -> a text of all that the view and the coding of the request say of a frame.
 * has_view: frames are drawn */
int cs_shooting_key(lua_State *L, const cs_script *script);
/* script:sounds_key() -> the hash of the sounds of the film, and of their files as they are now */
int cs_shooting_sounds_key(lua_State *L, cs_script *script);
/* script:stems() -> for each sound the name of the part of the mix that it belongs to */
int cs_shooting_stems(lua_State *L, cs_script *script);
/* script:write_sound{ path =, numbers =, depth = "16" or "float", stem =, gain = } -> the greatest
 * magnitude of a sample, the gain of --loudness, the bytes of the file and their hash. Without
 * `stem`, all sounds are heard; without `gain` it is found. Ends the verb if it fails. */
int cs_shooting_sound(lua_State *L, cs_script *script);
