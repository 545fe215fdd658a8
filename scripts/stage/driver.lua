--- The driver, a picture of its own, 160 by 120.
local function driver(f)
  local head = union {
    ellipse { 80, 128, 48, 34, fill = "#d1495b" },
    circle { 80, 66, 34, fill = "#c98f5a" },
    rect { 42, 56, 76, 18, radius = 9, fill = "#2f4a6d" },
    path { d = "M44 58 C44 8 116 8 116 58", fill = "#f5f1e6" },
    circle { 80, 86, 5, fill = "#432" } }
  return rostrum { size = { 160, 120 }, back = "#f3d08a", cel { head:rotate(5
      * math.sin(5 * f.time), 80, 120) } }
end

return driver
