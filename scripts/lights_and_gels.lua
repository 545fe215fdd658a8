-- A rose window: a wall of opaque paint, panes of pure gel. As the front light on the wall goes
-- down, the light behind the glass comes up: gels have no colour until light comes through them.

local cx, cy = 960, 540

local function disc(distance, radius, texture)
  return circle { cx, cy - distance, radius, fill = texture }
end

--- A drop that points to the middle.
local function drop(near, far, half, texture)
  local middle = near * 0.35 + far * 0.65
  local d = ("M%g %gC%g %g %g %g %g %gC%g %g %g %g %g %gZ"):format(
    cx, cy - near, cx - half * 1.5, cy - middle, cx - half, cy - far, cx, cy - far,
    cx + half, cy - far, cx + half * 1.5, cy - middle, cx, cy - near)
  return path { d = d, fill = texture }
end

--- `count` copies, around the middle.
local function wreath(count, part, offset)
  local list = {}
  for i = 0, count - 1 do list[i + 1] = part:rotate(360 * (i + (offset or 0)) / count, cx, cy) end
  return union(list)
end

--- One ring: glass between two radii, cut by spokes and by the leading around the ornaments.
local function ring(inner, outer, glass, spokes, ornaments, leading)
  local spoke = rect { cx - 3, cy - outer, 6, outer - inner }
  return (disc(0, outer, glass) - disc(0, inner) - wreath(spokes, spoke, 0.5) - leading) | ornaments
end

local blue, azure = gel(0.01, 0.04, 0.42), gel(0.04, 0.26, 0.62)
local ruby, rose = gel(0.66, 0.012, 0.03), gel(0.80, 0.16, 0.16)
local amber, green = gel(0.92, 0.42, 0.03), gel(0.03, 0.30, 0.13)

local window = union {
  ring(446, 506, azure, 24, wreath(24, disc(476, 20, ruby)), wreath(24, disc(476, 26))),
  ring(232, 436, blue, 12,
    wreath(12, drop(246, 424, 44, ruby)) | wreath(12, disc(392, 24, amber), 0.5)
      | wreath(12, disc(326, 15, rose), 0.5),
    wreath(12, drop(236, 430, 51)) | wreath(12, disc(392, 30), 0.5)
      | wreath(12, disc(326, 20), 0.5)),
  ring(84, 222, green, 12, wreath(12, drop(94, 214, 24, amber)), wreath(12, drop(86, 219, 30))),
  disc(0, 74, azure) - wreath(6, drop(4, 66, 22)), wreath(6, drop(8, 62, 17, rose)),
}

local stone = radial { centre = { cx, cy }, radius = 1100, { 0, "#7d6a58" },
                       { 0.46, "#8d7863" },
                       { 0.461, "#c2ab8c" }, { 0.5, "#a38b70" }, { 0.501, "#bba384" },
                       { 1, "#57494a" } }
local wall = rect { 0, 0, 1920, 1080, fill = stone } - window

local evening = ease "inOutSine"

return film { frames = 48, frame = function(f)
  local u = evening(f.progress)
  local front, back = 1 - 0.9 * u, 0.03 + 1.1 * u
  return {
    cel { window, back = { back, back * 0.97, back * 0.92 } },
    cel { wall, front = { front, front * (0.95 - 0.1 * u), front * (0.88 + 0.2 * u) } },
  }
end }
