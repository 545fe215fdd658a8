-- The pictures of the documentation: what each is a frame of. `./run docs` makes them anew.
--   script   a script of the tree
--   page     a page whose example of the same name it is
--   onion    how many frames before and after lie over it
--   grid     not a frame but a contact sheet of so many columns and rows
--   parts    frames that are rendered before, into a folder that the script gets as its argument
return {
  { name = "demo", script = "scripts/demo.lua", frame = 236, size = "960x540" },
  { name = "moon", page = "README.md", frame = 40 },
  { name = "beta", page = "docs/guide.md" },
  { name = "blending", page = "docs/guide.md" },
  { name = "waving", script = "scripts/waving.lua", frame = 14, size = "640x400" },
  { name = "shapes", page = "docs/guide.md", size = "640x360" },
  { name = "gel", page = "docs/guide.md" },
  { name = "dusk", page = "docs/guide.md", frame = 36 },
  { name = "lamplight", page = "docs/guide.md", frame = 18 },
  { name = "postcards", page = "docs/guide.md", frame = 1 },
  { name = "soft", page = "docs/guide.md", frame = 6 },
  { name = "gradients", page = "docs/guide.md" },
  { name = "poster", page = "docs/guide.md" },
  { name = "title", script = "scripts/title.lua", frame = 29, size = "640x360" },
  { name = "credits", script = "scripts/credits.lua", frame = 109, size = "640x360" },
  { name = "exposures", page = "docs/guide.md" },
  { name = "easing", page = "docs/guide.md" },
  { name = "blur", page = "docs/guide.md", frame = 10 },
  { name = "contact", script = "scripts/waving.lua", grid = "4x2" },
  { name = "onion", script = "scripts/waving.lua", frame = 14, onion = "2,1", size = "640x400" },
  { name = "primitives", script = "scripts/primitives.lua", frame = 9, size = "720x360" },
  { name = "strokes", script = "scripts/strokes.lua", frame = 30, size = "720x405" },
  { name = "booleans", script = "scripts/booleans.lua", frame = 24, size = "720x240" },
  { name = "lights_and_gels", script = "scripts/lights_and_gels.lua", frame = 40,
    size = "480x270" },
  { name = "light_table", script = "scripts/light_table.lua", frame = 30, size = "640x360" },
  { name = "parallax", script = "scripts/parallax.lua", frame = 24, size = "640x360" },
  { name = "lip_cels", script = "scripts/lip_cels.lua", frame = 24, size = "640x360" },
  { name = "dissolve", script = "scripts/dissolve.lua", frame = 24, size = "640x360" },
  { name = "gradient", script = "scripts/gradient.lua", frame = 24, size = "640x360" },
  { name = "picture", script = "scripts/picture.lua", frame = 40, size = "640x360" },
  { name = "layers", script = "scripts/layers.lua", frame = 20, size = "640x360" },
  { name = "valley", page = "docs/guide.md", frame = 32, size = "600x270" },
  { name = "exposure_sheet", script = "scripts/exposure_sheet.lua", frame = 8, size = "640x360" },
  { name = "night", page = "docs/guide-shot.md", frame = 40 },
  { name = "balloon", page = "docs/guide.md", frame = 24 },
  { name = "perspective", script = "scripts/perspective.lua", frame = 24, size = "640x360" },
  { name = "scanline", script = "scripts/scanline.lua", frame = 24, size = "640x360" },
  { name = "kernels", script = "docs/pictures/kernels.lua", parts = {
    { script = "scripts/kernels.lua", frame = 2, size = "384x160", file = "kernels.art.png" },
    { script = "scripts/kernels.lua", frame = "all", file = "kernels.#.png" } } },
}
