-- Eight moods: palettes from which scenes take their colours, so that no two of them look alike.
--
--   local mood = require("stage.moods").harvest
--   rect { 0, 0, 1280, 720, fill = linear(mood.sky) }
--
--   sky      three colours from above to the horizon, a gradient or a choice
--   far      what lies far away, near the colour of the horizon
--   near     what lies before it
--   ground   what carries the figures
--   light    sun, moon, lamps, and paper that is lit
--   accent   the one colour that the eye goes to: a coat, a boat, a word
--   ink      the darkest colour: lines, letters and figures against the light
--
-- Two or three roles make a picture; the accent covers the least of it.
return {
  fog = { sky = { "#aebfc0", "#cdd6d0", "#e6e4d8" }, far = "#b9c4bf", near = "#7f918f",
    ground = "#5d6f6c", light = "#f7f1df", accent = "#c8553d", ink = "#2e3a3d" },
  noon = { sky = { "#1f8fc4", "#6cc1e0", "#d9f0ea" }, far = "#7fb7a6", near = "#3f8f5f",
    ground = "#e8d18f", light = "#fffbe8", accent = "#f2542d", ink = "#123a4a" },
  harvest = { sky = { "#f3d9a0", "#f5c56b", "#ee9f3b" }, far = "#d98a3a", near = "#a9572b",
    ground = "#7a3b22", light = "#fff3cf", accent = "#1f6f78", ink = "#33180f" },
  storm = { sky = { "#28343c", "#45565c", "#84918a" }, far = "#5a6a6b", near = "#37464a",
    ground = "#232e32", light = "#dfe6cf", accent = "#f4c430", ink = "#12191d" },
  neon = { sky = { "#090a1f", "#141344", "#34176b" }, far = "#241a5c", near = "#130f33",
    ground = "#0b0920", light = "#37f0e0", accent = "#ff2e88", ink = "#05040f" },
  snow = { sky = { "#c3d7e6", "#dde8ee", "#f3f3ef" }, far = "#b4c8d6", near = "#7e9bb0",
    ground = "#fbfbf7", light = "#fff0c9", accent = "#d7263d", ink = "#22384a" },
  paper = { sky = { "#f4ecd8", "#efe4c9", "#e6d7b5" }, far = "#d9c9a3", near = "#a8977a",
    ground = "#e3d4b0", light = "#fffaf0", accent = "#c0392b", ink = "#2b2622" },
  candle = { sky = { "#120a08", "#2a140d", "#4d2413" }, far = "#3a1c11", near = "#6b3418",
    ground = "#1b0e09", light = "#ffd27a", accent = "#e0662b", ink = "#0a0504" },
}
