-- An empty kitchen at night; a mouse crosses it with a slice of cheese, until something creaks.
local gouache = require "town.gouache"
local window = require "town.window"
local mood = require("stage.moods").storm
local wash, form, line = gouache.wash, gouache.form, gouache.line

local room = union {
  gouache.wall(330, 170, 600, "#8d9a8c", "#5f706d", "#3d4c50", "#28343a", "#1b2428"),
  form(wash(250, 130, 400, 300, "#dfe6cf", "#b4bfa6"), "M262 146 H402 V300 H262 Z"),
  line("M332 146 V300 M262 222 H402", 9, "#37464a"), circle { 372, 184, 15, fill = mood.accent },
  form("#232e32", "M0 300 H150 V318 H0 Z"), form("#37464a", "M30 300 V252 H74 V300 Z M92 300 "
    .. "V236 H122 V300 Z"),
  line("M52 252 V236 H66", 6, "#37464a"),
  form("#2b383d", "M60 420 H230 V436 H60 Z M74 436 H90 V540 H74 Z M200 436 H216 V540 H200 Z"),
  form(wash(0, 540, 0, 600, "#45565c", "#28343c"), "M0 534 H450 V600 H0 Z"),
  form(rgb("#dfe6cf", 0.16), "M150 540 L320 540 L250 600 H40 Z"),
}

--- The mouse, walking to the right under its cheese; step: 0 or 1; afraid: it looks at us.
local function mouse(step, afraid)
  local grey = wash(-90, -150, 90, 0, "#8a979a", "#b4b8a8")
  return union { line(("M-84 -20 C-130 -20 -140 -%d -180 -50"):format(30 + 20 * step),
    7, "#c98f84"),
    line(step == 0 and "M-40 -10 L-54 4 M34 -10 L50 4" or "M-40 -10 L-28 4 M34 -10 L22 4",
      14, "#7d888a"),
    form(grey, "M-92 -8 C-104 -60 -60 -100 -6 -98 C30 -100 50 -92 62 -70 L92 -40 "
      .. "C96 -22 80 -10 60 -6 Z"),
    afraid and circle { 66, -98, 20, fill = "#8a979a" }
      | circle { 67, -96, 12, fill = "#d9a297" } or union {},
    circle { 92, -36, 8, fill = "#c9655a" },
    afraid and circle { 52, -62, 11, fill = "#f1f0da" } | circle { 50, -60, 6, fill = mood.ink }
      | circle { 78, -64, 9, fill = "#f1f0da" } | circle { 76, -62, 5, fill = mood.ink }
      or ellipse { 62, -58, 6, 8, fill = mood.ink },
    line("M74 -30 L110 -24 M74 -26 L106 -12", 2.4, "#dfe6cf"),
    form(mood.accent, "M-116 -124 L20 -190 C40 -172 44 -152 42 -130 Z"),
    form("#c99b1c", "M-116 -124 L42 -130 L40 -98 L-112 -94 Z"),
    circle { -30, -148, 9, fill = "#c99b1c" }, circle { 14, -158, 12, fill = "#c99b1c" },
    circle { -50, -110, 7, fill = "#a3761c" }, circle { -4, -114, 9, fill = "#a3761c" },
    circle { 26, -92, 27, fill = "#9aa5a4" }, circle { 28, -90, 16, fill = "#d9a297" },
    line("M-50 -80 L-58 -98", 14, "#8a979a") }
end

local way = gouache.track({ 0, 110 }, { 5, 226, "linear" }, { 11, 226 }, { 12, 240 },
  { 17, 640, "linear" },
  { 18, -190 }, { 24, 110, "linear" })

return window.film { title = "The cheese", by = "ga", seconds = 4, drawing = function(_, number)
  local n = number // 2
  local x = way:at(n)
  local still = n >= 5 and n < 11
  local afraid = n >= 6 and n < 11
  local y = still and 556 or 556 - n % 2 * 9
  return { room, x < 600 and mouse(still and 0 or n % 2, afraid):scale(1.15):translate(x, y)
    or union {} }
end }
