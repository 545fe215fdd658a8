-- The pictures of the documentation, and the script of each. `./run docs` makes all of them again.
--   script   a script of the tree
--   page     a page with an example of the same name
--   onion    the number of frames before and after it that are shown behind it
--   strip    the numbers of frames that are shown side by side, instead of one frame
--   grid     a contact sheet with this number of columns and rows, instead of a frame
--   background   a colour behind a frame that is transparent
--   size     in pixels; of a frame, or what the contact sheet is made smaller to
--   allow    a folder that the script may read, in addition to its own
--   before   an example of the page that is run first, a program in plain Lua
--   parts    frames that are rendered first, to a folder that the script gets as its argument
local list = {
  { name = "demo", script = "scripts/demo.lua", frame = 193, size = "800x450" },
  { name = "little-one", script = "scripts/film.lua", frame = 463, size = "400x225" },
  { name = "moon", page = "README.md", frame = 40 },
  { name = "beta", page = "docs/guide.md" },
  { name = "blending", page = "docs/guide.md" },
  { name = "walking", script = "scripts/walking.lua", frame = 10, size = "640x396" },
  { name = "fox", script = "scripts/fox.lua", frame = 26, size = "480x270" },
  { name = "turn", script = "scripts/turn.lua", grid = "4x2", size = "880x293" },
  { name = "sea", script = "scripts/sea.lua", frame = 60, size = "560x315" },
  { name = "waving", script = "scripts/waving.lua", frame = 14, size = "640x400" },
  { name = "shapes", page = "docs/guide.md", size = "640x360" },
  { name = "gel", page = "docs/guide.md" },
  { name = "dusk", page = "docs/guide.md", strip = "1,26,48" },
  { name = "lamplight", page = "docs/guide.md", frame = 18, size = "480x270" },
  { name = "postcards", page = "docs/guide.md", frame = 1 },
  { name = "soft", page = "docs/guide.md", frame = 6, size = "480x270" },
  { name = "lagoon", page = "docs/guide.md" },
  { name = "stickers", page = "docs/guide.md" },
  { name = "gradients", page = "docs/guide.md" },
  { name = "poster", page = "docs/guide.md" },
  { name = "title", script = "scripts/title.lua", frame = 29, size = "640x360" },
  { name = "credits", script = "scripts/credits.lua", frame = 109, size = "640x360" },
  { name = "exposures", page = "docs/guide.md", size = "480x270" },
  { name = "easing", page = "docs/guide.md" },
  { name = "blur", page = "docs/guide.md", frame = 10 },
  { name = "contact", script = "scripts/waving.lua", grid = "4x2", size = "1188x396" },
  { name = "onion", script = "scripts/waving.lua", frame = 9, onion = "2,1", size = "640x400" },
  { name = "primitives", script = "scripts/primitives.lua", frame = 9, size = "720x360" },
  { name = "strokes", script = "scripts/strokes.lua", frame = 30, size = "720x405" },
  { name = "booleans", script = "scripts/booleans.lua", frame = 24, size = "720x240" },
  { name = "lights_and_gels", script = "scripts/lights_and_gels.lua", frame = 40,
    size = "480x270" },
  { name = "light_table", script = "scripts/light_table.lua", frame = 30, size = "640x360" },
  { name = "parallax", script = "scripts/parallax.lua", frame = 24, size = "480x270" },
  { name = "pan", script = "scripts/pan.lua", frame = 30, size = "480x270" },
  { name = "rack_focus", script = "scripts/rack_focus.lua", frame = 54, size = "480x200" },
  { name = "lip_cels", script = "scripts/lip_cels.lua", frame = 24, size = "480x270" },
  { name = "dissolve", script = "scripts/dissolve.lua", frame = 24, size = "640x360" },
  { name = "gradient", script = "scripts/gradient.lua", frame = 24, size = "480x270" },
  { name = "picture", script = "scripts/picture.lua", frame = 40, size = "480x270" },
  { name = "layers", script = "scripts/layers.lua", frame = 20, size = "480x270" },
  { name = "trace", script = "scripts/trace.lua", frame = 20, size = "640x360" },
  { name = "inked", page = "docs/guide.md", size = "560x380" },
  { name = "valley", page = "docs/guide.md", frame = 32, size = "480x216" },
  { name = "exposure_sheet", script = "scripts/exposure_sheet.lua", frame = 8, size = "640x360" },
  { name = "night", page = "docs/guide-shot.md", frame = 40, size = "480x270" },
  { name = "brush_lines", page = "docs/lua.md", frame = 40 },
  { name = "day", page = "docs/guide-film.md", grid = "4x3", size = "1188x536" },
  { name = "page", page = "docs/guide-film.md", frame = 24, size = "480x270" },
  { name = "listener", page = "docs/guide-film.md", frame = 30, before = "sounds" },
  { name = "balloon", page = "docs/guide.md", frame = 24, size = "480x270" },
  { name = "hat", script = "scripts/hat.lua", frame = 40, size = "480x270" },
  { name = "evening", script = "scripts/relight.lua", frame = 80, size = "480x270" },
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
  { name = "kernels", script = "docs/pictures/kernels.lua", parts = {
    { script = "scripts/kernels.lua", frame = 2, size = "384x160", file = "kernels.art.png" },
    { script = "scripts/kernels.lua", frame = "all", file = "kernels.#.png" } } },
}

-- The recipes of the cookbook, each with the frame that is shown, and its size if it has many
-- shades; or, if what matters is the movement, with the frames of a strip.
for _, recipe in ipairs {
  { "cast_shadow", 12 }, { "drop_shadow", 10, "360x202" }, { "neon_glow", 24, "360x202" },
  { "soft_vignette", 1, "360x202" }, { "stained_glass", 20, "360x202" },
  { "time_lapse", strip = "28,52,82" }, { "letter_mask", 20 }, { "clock_wipe", strip = "8,20,32" },
  { "iris_out", strip = "10,22,31" }, { "endless_zoom", strip = "1,17,33" }, { "split_screen", 8 },
  { "green_screen", 20 }, { "picture_in_picture", 60 }, { "kaleidoscope", 1 },
  { "lower_third", 30 }, { "karaoke_line", 27 }, { "rolling_credits", 120 },
  { "three_languages", 12 }, { "text_on_path", 40 }, { "speech_bubble", 20 },
  { "falling_letters", 24 }, { "typewriter", 72 }, { "srt_subtitles", 96 }, { "handwriting", 52 },
  { "bar_race", 57 }, { "pie_chart", 44 }, { "line_chart", 50 }, { "rolling_counter", 30 },
  { "island_map", 40 }, { "value_map", 60 }, { "many_scripts", 60 },
  { "paper_texture", 1, "360x202" }, { "boiling_line", strip = "1,4,7" },
  { "hatching", 1, "360x202" }, { "halftone_dots", 1, "360x202" }, { "snowfall", 30, "360x202" },
  { "water_reflection", 10 }, { "squash_stretch", strip = "16,20,25" }, { "magnifying_lens", 40 },
  { "old_film", 12, "360x202" }, { "morph_shapes", strip = "8,14,20" },
  { "confetti_burst", strip = "6,17,34" }, { "camera_shake", strip = "30,37,41" },
  { "sprite_sheet", 1 }, { "transparent_video", 30, background = "#21465a" },
  { "crossfade", strip = "24,31,37" }, { "rotoscope", strip = "1,3,7" },
  { "speed_ramp", strip = "9,30,62" }, { "mixed_sound", 66 },
  { "light_rays", 30, "360x202" }, { "glitch_title", strip = "9,30" }, { "logo_reveal", 84 },
  { "film_leader", 32, "360x202" }, { "every_shape", 20 }, { "scarf_walk", 40 },
  { "harvest_charts", 72 }, { "deep_title", 20, "360x202" }, { "cel_shading", 18 },
} do
  list[#list + 1] = { name = recipe[1], page = "docs/cookbook.md", frame = recipe[2],
    size = recipe[3], strip = recipe.strip, background = recipe.background }
end

return list
