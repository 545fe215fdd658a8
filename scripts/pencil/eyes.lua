-- The eyes of pencil.lua: pupils and lids, drawn by the program, so that they follow a place and
-- blink on every drawing.

--- A lid down to a share of an eye, and its edge.
local function lid(x, y, rx, ry, share, p)
  local edge = y - ry + 2 * ry * math.min(share, 0.78)
  local side = rx * math.sqrt(1 - ((edge - y) / ry) ^ 2)
  local curve = ("Q%g %g %g %g"):format(x, edge + 0.7 * ry * share, x - side, edge)
  return path { fill = p.skin, d = ("M%g %gA%g %g 0 %d 1 %g %g%sZ"):format(x - side, edge, rx, ry,
      share > 0.5 and 1 or 0, x + side, edge, curve) },
    stroke { d = ("M%g %g%s"):format(x + side, edge, curve), width = 2.2, cap = "round",
      fill = p.line }
end

--- The eyes at the places of paint.lua, in the colours of a palette. They look at a place; `closed`
--- is 0 to 1. All parts have names, for in-betweens.
return function(places, p, look, closed)
  local list = {}
  local function add(object, name, place)
    list[#list + 1] = object:named(("%s at %d"):format(name, place))
  end
  for i, place in ipairs(places) do
    local x, y, name, r = table.unpack(place)
    if name == "eye" then
      local dx, dy = look[1] - x, look[2] - y
      local reach = 0.36 * r * (1 - closed) / math.max(r, math.sqrt(dx * dx + dy * dy))
      local px, py = x + dx * reach, y + dy * reach + 0.4 * r * closed -- down with the lid
      add(ellipse { px, py, 0.46 * r, 0.54 * r, fill = p.pupil }, "pupil", i)
      add(circle { px + 0.12 * r, py - 0.17 * r, 0.14 * r, fill = p.eye }, "glint", i)
      if closed > 0 then
        local skin, edge = lid(x, y, 0.9 * r - 0.5, r - 0.5, closed, p)
        add(skin, "lid", i)
        add(edge, "edge", i)
      end
    end
  end
  return union(list)
end
