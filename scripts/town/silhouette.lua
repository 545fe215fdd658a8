-- What the silhouettes of the town share: ink, limbs, and lamplight.
local silhouette = {}

local function side(from, to, width)
  local dx, dy = to[1] - from[1], to[2] - from[2]
  local half = width / 2 / math.max(1e-6, math.sqrt(dx * dx + dy * dy))
  return -dy * half, dx * half
end

--- An arm, a leg or a tail: a soft line from one point { x, y, width } to another, which bends
--- towards a third one between them. Its outline has few pieces, which keeps planes small.
function silhouette.limb(from, bend, to)
  local fx, fy = side(from, bend, from[3])
  local bx, by = side(from, to, bend[3])
  local tx, ty = side(bend, to, to[3])
  local function round(x, y, nx, ny)
    local ax, ay = 1.33 * ny, -1.33 * nx
    return ("C%.1f %.1f %.1f %.1f %.1f %.1f"):format(x + nx + ax, y + ny + ay, x - nx + ax,
      y - ny + ay, x - nx, y - ny)
  end
  local ends = { round(to[1], to[2], tx, ty), round(from[1], from[2], -fx, -fy) }
  return path { d = ("M%.1f %.1f Q%.1f %.1f %.1f %.1f %s Q%.1f %.1f %.1f %.1f %s Z"):format(
    from[1] + fx, from[2] + fy, bend[1] + bx, bend[2] + by, to[1] + tx, to[2] + ty,
    ends[1], bend[1] - bx, bend[2] - by, from[1] - fx, from[2] - fy, ends[2]) }
end

--- An eye that is cut out of a head: open 0 (a line) to 1, and where its pupil looks, -1..1.
function silhouette.eye(x, y, size, open, look)
  if open < 0.1 then
    return path { d = ("M%g %g q%g %g %g 0 q%g %g %g 0 Z"):format(x - size, y - 0.1 * size, size,
      1.4 * size, 2 * size, -size, 0.6 * size, -2 * size) }
  end
  return ellipse { x, y, size, size * open }
    - circle { x + (look or 0) * 0.45 * size, y, 0.45 * size }
end

--- A wall w by h with a lamp's light about (x, y).
function silhouette.wall(w, h, x, y, colours)
  return rect { 0, 0, w, h, fill = radial { centre = { x, y }, radius = h * 0.62,
    { 0, colours[1] }, { 0.35, colours[2] }, { 1, colours[3] } } }
end

--- An open hand, the palm to us, its wrist at (0, 0), its fingers up; a thumb to the left.
function silhouette.hand()
  local function finger(degrees, x, y, long)
    return silhouette.limb({ x, y, 19 }, { x, y - long / 2, 19 }, { x, y - long, 16 })
      :rotate(degrees, x, y)
  end
  return path { d = "M-20 120 L-20 0 C-40 -20 -44 -50 -32 -70 L30 -70 C40 -40 30 -14 20 0 "
      .. "L24 120 Z" } | finger(-16, -24, -62, 56) | finger(-5, -8, -68, 66)
    | finger(6, 10, -68, 60) | finger(18, 24, -60, 44) | finger(-62, -28, -24, 52)
end

--- A blind on which hands throw shadows of the colour `silhouette.shadow`.
silhouette.shadow = "#7d3615"
function silhouette.blind()
  return rect { 0, 0, 450, 600, fill = "#e08a34" } | circle { 225, 268, 200,
    fill = radial { centre = { 150, 420 }, radius = 400, { 0, "#fff4d8" }, { 1, "#ffd27a" } } }
    | rect { 17, 17, 416, 18, fill = "#0a0504" }
end

return silhouette
