local field = rect {
  0, 0, 480, 270,
  fill = linear { from = { 0, 0 }, to = { 0, 270 }, { 0, "#9fd0e6" }, { 0.5, "#f2f0d2" },
    { 0.52, "#a9c46c" }, { 1, "#557f3f" } } }
local function hive(x, paint)
  return rect { x, 104, 70, 78, radius = 4, fill = paint }
    | rect { x - 6, 95, 82, 12, radius = 4, fill = "#7b5b41" }
    | rect { x, 140, 70, 3, fill = "#00000050" }
end

--- The keeper of the bees, by the morning sun from the right: she looks at what she says.
local suit = path { fill = "#f1ede0", d = [[M222 290 C226 226 280 208 322 196 L350 214 L378 196
  C424 208 470 226 476 290 Z]] }
local folds = stroke { width = 2.5, cap = "round", fill = "#cfc8b4",
  d = "M262 290 C262 262 270 246 280 234 M440 290 C440 262 432 248 424 238 M350 216 V290" }
local collar = path { d = "M318 198 L350 216 L382 198 L390 212 L352 238 L310 212 Z",
  fill = "#dcd5c0" }
local braid = stroke { points = { { 388, 150, 22 }, { 404, 190, 20 }, { 396, 232, 12 },
  { 400, 262, 5 } }, degree = 3, cap = "round", fill = "#4a2a1d" }
local hair = path { fill = "#4a2a1d", d = [[M302 124 C298 162 312 190 326 194 L376 194
  C398 180 402 150 398 122 Z]] }
local neck = path { d = "M330 172 H370 V198 Q350 214 330 198 Z", fill = "#b57a52" }
local face = path { fill = "#dda076", d = [[M308 120 C306 150 314 174 334 184
  C342 188 352 188 360 184 C382 174 392 148 390 118 Z]] }
local light = clip(path { d = "M372 96 C392 120 380 168 356 190 L410 190 V96 Z", fill = "#f2c092" },
  face)
local cheek = ellipse { 320, 156, 9, 6, fill = "#cf7a5a70" } | ellipse { 370, 155, 10, 6,
  fill = "#cf7a5a70" }
local eye = ellipse { 0, 0, 6.5, 4 }
local function look(x)
  return (clip(eye:paint "#fdf8ee" | circle { -2, 0, 4, fill = "#4b3a22" }
    | circle { -3.2, -1.3, 1.2, fill = "#fff" }, eye)
    | stroke { d = "M-8 0 Q-1 -7 8 -1", width = 2.2, cap = "round", fill = "#33201a" })
    :translate(x, 139)
end
local lines = stroke { width = 3, cap = "round", fill = "#4a2a1d",
    d = "M317 129 Q324 124 333 127 M353 127 Q363 123 372 128" }
  | stroke { d = "M341 138 Q334 153 335 157 Q338 161 344 159", width = 2.4, cap = "round",
    fill = "#b0704a" }
  | path { d = "M328 168 Q343 172 362 166 Q346 184 328 168 Z", fill = "#8e3532" }
  | path { d = "M332 169.5 Q344 172 357 168 L355 171 Q344 175 334 172 Z", fill = "#fff6ea" }

local weave = {}
for i = 0, 4 do
  weave[i + 1] = stroke { width = 1.2, fill = "#b88f4e",
    d = ("M%g %g Q349 %g %g %g"):format(306 + 4 * i, 96 - 9 * i, 104 - 11 * i, 393 - 5 * i,
      96 - 9 * i) }
end
local crown = path { d = "M304 104 C304 40 394 40 394 104 Q349 118 304 104 Z", fill = "#e6c27c" }
local hat = union { path { fill = "#d3a95f", d = [[M246 118 C258 88 440 84 456 114 C440 128 400 124
    349 122 C300 122 262 132 246 118 Z]] },
  crown, clip(union(weave), crown),
  path { d = "M303 98 Q349 114 395 98 L395 110 Q349 124 303 110 Z", fill = "#8e3f2c" },
  path { d = "M300 120 Q349 112 398 120 Q392 134 384 130 Q349 120 314 131 Q304 134 300 120 Z",
    fill = "#7a502f60" } }
local keeper = union { hair, neck, suit, folds, braid, collar, face, light, cheek, look(324),
  look(361), lines, hat }

return { field = field, hive = hive, keeper = keeper }
