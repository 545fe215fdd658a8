-- The pictures of the documentation, and the script of each. `./run docs` makes all of them again.
--   script   a script of the tree
--   page     a page with an example of the same name
--   onion    the number of frames before and after it that are shown behind it
--   loop     "all", or the frames, of NAME.webp: a picture that moves, instead of NAME.png
--   strip    the numbers of frames that are shown side by side, instead of one frame
--   grid     a contact sheet with this number of columns and rows, instead of a frame
--   frames   of the contact sheet, instead of all
--   background   a colour behind a frame that is transparent
--   size     in pixels; of a frame, or what the contact sheet is made smaller to
--   crop     x,y,w,h: only this part of a frame of that size
--   quality  of a loop, 50 by default
--   fps      of a loop, 12 by default
--   most     bytes that a loop may have, 150,000 by default
--   off      codes by which a loop may differ from what made it, 14 by default (see off.py)
--   still    "webp" for a frame that is larger as a PNG
--   set      a parameter and its value
--   allow    a folder that the script may read, in addition to its own
--   before   the page and name of an example that is run first, a program in plain Lua
--   parts    frames that are rendered first, to a folder that the script gets as its argument
local SOUNDS, PLATES = { "docs/guide-film.md", "sounds" }, { "docs/cookbook.md", "plates" }

local list = {
  { name = "demo", script = "scripts/demo.lua", frame = 193, size = "960x540", still = "webp" },
  { name = "moving", script = "docs/pictures/moving.lua", loop = "all", size = "960x540",
    fps = "24", quality = "26", most = 2200000 },
  { name = "little-one", script = "scripts/film.lua", frame = 463, size = "960x540",
    still = "webp" },
  { name = "town", script = "scripts/town.lua", frame = 97, size = "960x540", still = "webp",
    allow = "scripts" },
  { name = "town_zoom", script = "docs/pictures/town_zoom.lua", loop = "all", size = "234x416",
    allow = "scripts", quality = "26" },
  { name = "works/puddle", script = "scripts/works/puddle.lua", frame = 115, size = "960x540",
    still = "webp", allow = "scripts", set = "grain=0" },
  { name = "works/thread", script = "scripts/works/thread.lua", frame = 109, size = "960x540",
    still = "webp", allow = "scripts", set = "grain=0" },
  { name = "works/rooster", script = "scripts/works/rooster.lua", loop = "157-158",
    size = "960x540", quality = "60", allow = "scripts", set = "grain=0" }, -- as of press, below
  { name = "works/moon_cat", script = "scripts/works/moon_cat.lua", frame = 161, size = "960x540",
    still = "webp", allow = "scripts" },
  { name = "works/room", script = "scripts/works/room.lua", frame = 128, size = "960x540",
    still = "webp", allow = "scripts" },
  { name = "works/quarter_turns", script = "scripts/works/quarter_turns.lua", frame = 37,
    size = "640x640", still = "webp", allow = "scripts" },
  { name = "works/press", script = "scripts/works/press.lua", loop = "153-154", size = "960x540",
    allow = "scripts" }, -- two frames that are the same: grain is small only in a video
  { name = "works/billion", script = "scripts/works/billion.lua", frame = 213, size = "960x540",
    still = "webp", allow = "scripts" },
  { name = "works/egg", script = "scripts/works/egg.lua", frame = 232, size = "360x640",
    still = "webp", allow = "scripts" },
  { name = "works/slip", script = "scripts/works/slip.lua", frame = 186, size = "960x540",
    still = "webp", allow = "scripts" },
  { name = "tile_puddle", script = "scripts/works/puddle.lua", loop = "191-228", size = "480x270",
    quality = "23", most = 96000, off = 18, allow = "scripts", set = "grain=0" },
  { name = "tile_billion", script = "scripts/works/billion.lua", loop = "94-141", size = "480x270",
    quality = "54", most = 90000, allow = "scripts" },
  { name = "tile_room", script = "scripts/works/room.lua", loop = "109-156", size = "480x270",
    quality = "36", most = 90000, allow = "scripts" },
  { name = "tile_thread", script = "scripts/works/thread.lua", loop = "86-133", size = "480x270",
    quality = "55", most = 90000, allow = "scripts", set = "grain=0" },
  { name = "moon", page = "README.md", loop = "all", size = "480x270" },
  { name = "dot", page = "docs/first-hour.md", loop = "all", size = "480x270" },
  { name = "hop", page = "docs/first-hour.md", loop = "all", size = "480x270" },
  { name = "hello", page = "docs/first-hour.md", loop = "all", size = "480x270" },
  { name = "gull", page = "docs/first-hour.md", loop = "all", size = "480x270" },
  { name = "coast", page = "docs/first-hour.md", loop = "all", size = "480x270",
    quality = "60" },
  { name = "premiere", page = "docs/first-hour.md", loop = "all", size = "480x270",
    quality = "53", before = SOUNDS },
  { name = "beta", page = "docs/guide-picture.md" },
  { name = "blending", page = "docs/guide.md" },
  { name = "walking", script = "scripts/walking.lua", frame = 10, size = "640x396" },
  { name = "fox", script = "scripts/fox.lua", frame = 36, size = "960x540" },
  { name = "turn", script = "scripts/turn.lua", grid = "4x2", size = "880x293" },
  { name = "sea", script = "scripts/sea.lua", frame = 60, size = "560x315" },
  { name = "waving", script = "scripts/waving.lua", frame = 14, size = "640x400" },
  { name = "shapes", page = "docs/guide-picture.md", size = "640x360" },
  { name = "gel", page = "docs/guide-picture.md" },
  { name = "dusk", page = "docs/guide.md", strip = "1,26,48" },
  { name = "lamplight", page = "docs/guide.md", frame = 22, size = "640x360", still = "webp" },
  { name = "postcards", page = "docs/guide-picture.md", frame = 1, still = "webp" },
  { name = "soft", page = "docs/guide.md", frame = 6, size = "640x360", still = "webp" },
  { name = "stickers", page = "docs/guide-picture.md" },
  { name = "gradients", page = "docs/guide-picture.md" },
  { name = "poster", page = "docs/guide.md" },
  { name = "title", script = "scripts/title.lua", frame = 44, size = "640x360" },
  { name = "credits", script = "scripts/credits.lua", frame = 109, size = "640x360" },
  { name = "exposures", page = "docs/guide-picture.md", frame = 4, size = "640x360",
    still = "webp" },
  { name = "easing", page = "docs/guide.md" },
  { name = "blur", page = "docs/guide-picture.md", frame = 10 },
  { name = "contact", script = "scripts/waving.lua", grid = "4x2", size = "990x330" },
  { name = "onion", script = "scripts/waving.lua", frame = 9, onion = "2,1", size = "640x400" },
  { name = "primitives", script = "scripts/primitives.lua", frame = 9, size = "720x360" },
  { name = "strokes", script = "scripts/strokes.lua", frame = 30, size = "720x405" },
  { name = "booleans", script = "scripts/booleans.lua", frame = 24, size = "720x240" },
  { name = "lights_and_gels", script = "scripts/lights_and_gels.lua", frame = 40,
    size = "640x360", still = "webp" },
  { name = "light_table", script = "scripts/light_table.lua", frame = 30, size = "560x315" },
  { name = "parallax", script = "scripts/parallax.lua", frame = 24, size = "640x360",
    still = "webp" },
  { name = "pan", script = "scripts/pan.lua", frame = 30, size = "480x270" },
  { name = "terapixel", script = "docs/pictures/terapixel.lua", size = "480x270", still = "webp",
    parts = {
      { script = "scripts/terapixel.lua", size = "630x630", crop = "211,198,208,360",
        file = "terapixel.1.png" },
      { script = "scripts/terapixel.lua", size = "21667x21667", crop = "9258,14857,208,360",
        file = "terapixel.2.png" },
      { script = "scripts/terapixel.lua", size = "693333x693333", crop = "299665,480688,208,360",
        file = "terapixel.3.png" } } },
  { name = "rack_focus", script = "scripts/rack_focus.lua", frame = 54, size = "640x267" },
  { name = "rack-focus", script = "scripts/rack_focus.lua", grid = "1x3", size = "336x456" },
  { name = "lip_cels", script = "scripts/lip_cels.lua", frame = 24, size = "480x270" },
  { name = "dissolve", script = "scripts/dissolve.lua", strip = "1,24,48" },
  { name = "gradient", script = "scripts/gradient.lua", frame = 24, size = "480x270" },
  { name = "picture", script = "scripts/picture.lua", frame = 40, size = "640x360",
    still = "webp" },
  { name = "layers", script = "scripts/layers.lua", frame = 20, size = "640x360",
    still = "webp" },
  { name = "trace", script = "scripts/trace.lua", frame = 20, size = "640x360" },
  { name = "inked", page = "docs/guide-picture.md", size = "560x380" },
  { name = "valley", page = "docs/guide.md", frame = 32, size = "640x288", still = "webp" },
  { name = "exposure_sheet", script = "scripts/exposure_sheet.lua", frame = 8, size = "640x360" },
  { name = "pencil_lines", page = "docs/from-pencil.md" },
  { name = "pencil_between", page = "docs/from-pencil.md" },
  { name = "pencil_paint", page = "docs/from-pencil.md" },
  { name = "pencil_night", script = "scripts/pencil.lua", frame = 62, size = "480x270",
    set = "time=night" },
  { name = "pencil", script = "scripts/pencil.lua", loop = "all", size = "256x144",
    quality = "20" },
  { name = "night", page = "docs/guide-shot.md", frame = 40, size = "480x270" },
  { name = "badges", page = "docs/cookbook.md", loop = "all" },
  { name = "brush_lines", page = "docs/lua-shapes.md", frame = 40 },
  { name = "operators", page = "docs/lua-objects.md" },
  { name = "loader", page = "docs/lua-drawings.md", grid = "4x1", size = "670x134" },
  { name = "day", page = "docs/guide-film.md", grid = "3x2", frames = "30,136,173,198,224,252",
    size = "960x387", still = "webp" },
  { name = "page", page = "docs/guide-film.md", frame = 24, size = "480x270" },
  { name = "listener", page = "docs/guide-film.md", frame = 30, before = SOUNDS },
  { name = "hat", script = "scripts/hat.lua", frame = 40, size = "480x270" },
  { name = "relight", script = "docs/pictures/relight.lua", allow = "scripts", still = "webp",
    parts = {
      { script = "scripts/relight.lua", frame = 1, size = "320x480", file = "relight.1.png" },
      { script = "scripts/relight.lua", frame = 60, size = "320x480", file = "relight.2.png" },
      { script = "scripts/relight.lua", frame = 120, size = "320x480", file = "relight.3.png" } } },
  { name = "perspective", script = "scripts/perspective.lua", frame = 24, size = "640x360" },
  { name = "scanline", script = "scripts/scanline.lua", frame = 24, size = "640x360" },
  { name = "paper-01", script = "scripts/paper/figure01.lua", size = "480x360", allow = "scripts" },
  { name = "paper-04", script = "scripts/paper/figure04.lua", size = "640x360", allow = "scripts" },
  { name = "paper-06", script = "scripts/paper/figure06.lua", size = "720x195", allow = "scripts" },
  { name = "paper-07", script = "scripts/paper/figure07.lua", size = "720x188", allow = "scripts" },
  { name = "paper-08", script = "scripts/paper/figure08.lua", size = "720x360", allow = "scripts" },
  { name = "paper-09", script = "scripts/paper/figure09.lua", size = "720x420", allow = "scripts" },
  { name = "paper-10", script = "scripts/paper/figure10.lua", size = "640x360", allow = "scripts" },
  { name = "paper-11", script = "scripts/paper/figure11.lua", size = "720x352", allow = "scripts" },
  { name = "paper-12", script = "scripts/paper/figure12.lua", size = "400x400", allow = "scripts" },
  { name = "paper-15a", script = "scripts/paper/figure15a.lua", size = "320x320",
    allow = "scripts" },
  { name = "paper-15b", script = "scripts/paper/figure15b.lua", size = "400x300",
    allow = "scripts" },
  { name = "paper-15c", script = "scripts/paper/figure15c.lua", size = "400x300",
    allow = "scripts" },
  { name = "paper-15d", script = "scripts/paper/figure15d.lua", size = "400x300",
    allow = "scripts" },
  { name = "kernels", script = "docs/pictures/kernels.lua", allow = "scripts", parts = {
    { script = "scripts/kernels.lua", frame = 2, size = "384x160", file = "kernels.art.png" },
    { script = "scripts/kernels.lua", frame = "all", file = "kernels.#.png" } } },
}

-- The recipes of the cookbook, each with the frames that are shown: of a loop, or the only one.
for _, recipe in ipairs {
  { "cast_shadow", "all", "288x162", quality = "30" }, { "drop_shadow", "all" },
  { "neon_glow", "all" }, { "bloom", "all" }, { "light_wrap", "all" },
  { "soft_vignette", 1, "360x202" }, { "time_lapse", "all", "320x180", quality = "28" },
  { "clock_wipe", "all" }, { "iris_out", "all" }, { "endless_zoom", "all" },
  { "split_screen", "all", "320x180", quality = "28" },
  { "green_screen", "all", "320x180", quality = "36" },
  { "picture_in_picture", "1-48", "320x180", quality = "28" },
  { "kaleidoscope", "all", "288x162", quality = "20", off = 20 }, { "lower_third", "all" },
  { "karaoke_line", "all", "320x180" }, { "three_languages", "all" },
  { "text_on_path", "all", "288x162", quality = "25" }, { "speech_bubble", "all" },
  { "falling_letters", "all" }, { "typewriter", "all" }, { "srt_subtitles", "73-144" },
  { "handwriting", "all" }, { "bar_race", "all", "320x180", quality = "28" },
  { "line_chart", "all", "480x270" }, { "rolling_counter", "1-48" }, { "island_map", "all" },
  { "value_map", "1-72", "320x180", quality = "28" }, { "many_scripts", "all", off = 24 },
  { "paper_texture", 1, "320x180" }, { "hatching", 1, "360x202" },
  { "halftone_dots", 1, "360x202" }, { "three_depths", "all", "320x180", quality = "28" },
  { "snowfall", "all", "320x180", quality = "28" }, { "clouds", 30, "480x270", still = "webp" },
  { "water_reflection", "all", "320x180", quality = "43" },
  { "heat_haze", "1-48", "320x180", quality = "43" }, { "squash_stretch", "all" },
  { "magnifying_lens", "1-48", "320x180", quality = "28" }, { "colour_fringes", 1, "320x180" },
  { "old_film", "1-24", "320x180", quality = "26" }, { "morph_shapes", "all" },
  { "confetti_burst", "1-42", "320x180", quality = "28", off = 24 },
  { "camera_shake", "24-60", "320x180", quality = "30" },
  { "race_car", "1-48", "320x180", quality = "28" }, { "sprite_sheet", 1, "360x202" },
  { "transparent_video", "1-48", background = "#21465a" }, { "crossfade", "12-48" },
  { "rotoscope", "1-8", "480x270" }, { "speed_ramp", "all" },
  { "mixed_sound", "49-96", "320x180", off = 24 },
  { "dancing_city", "97-144", "320x180", quality = "28", before = SOUNDS, off = 24 },
  { "over_footage", "all", before = PLATES },
  { "light_rays", "1-48", "320x180", quality = "28" },
  { "glitch_title", "1-48", "320x180", quality = "40", off = 24 }, { "logo_reveal", "all" },
  { "film_leader", "1-48", "320x180", quality = "28" },
  { "every_shape", "all", "320x180", quality = "27" },
  { "scarf_walk", "1-48", "320x180", quality = "28" }, { "harvest_charts", "all" },
  { "deep_title", "all", "320x180", quality = "24" },
  { "cel_shading", "1-48", "320x180", quality = "28" }, { "boiling_lines", "all" },
  { "paint_on_twos", "all", quality = "28" }, { "smear_frame", "all", quality = "28" },
  { "day_and_night", "all", "320x180", quality = "32" },
} do
  local frames, size = recipe[2], recipe[3]
  local loop = type(frames) == "string" and frames or nil
  list[#list + 1] = { name = recipe[1], page = "docs/cookbook.md", frame = not loop and frames,
    loop = loop, size = size or loop and "360x202", background = recipe.background,
    before = recipe.before, quality = recipe.quality, off = recipe.off, still = recipe.still }
end

--- The name of the file of a picture.
function list.file_of(picture)
  return ("%s.%s"):format(picture.name, picture.still or picture.loop and "webp" or "png")
end

return list
