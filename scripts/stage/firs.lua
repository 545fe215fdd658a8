local function fir(x, base, size, colour)
  local parts = rect { -4, -10, 8, 14, fill = "#6b4f3f" }
  for i = 0, 3 do
    local w, y = 34 - 7 * i, -8 - 20 * i
    parts = parts
      | path {
        d = ("M%g %g Q0 %g %g %g L0 %g Z"):format(-w, y, y + 9, w, y, y - 34),
        fill = colour }
      | path {
        d = ("M%g %g L0 %g L%g %g Q0 %g %g %g Z")
          :format(-w * 0.55, y - 14, y - 34, w * 0.55, y - 14, y - 16, -w * 0.55, y - 14),
        fill = "#f7fbff" }
  end
  return parts:scale(size):translate(x, base)
end
local ground = union {
  path { d = "M0 190 C120 160 250 200 480 168 V270 H0 Z", fill = "#e3edf5" },
  fir(70, 196, 0.8, "#4f7f73"),
  fir(150, 186, 0.6, "#5f8f83"),
  fir(405, 186, 0.9, "#457468"),
  fir(330, 192, 0.55, "#6a988c"),
  path { d = "M0 236 C160 200 320 250 480 218 V270 H0 Z", fill = "#fbfdff" },
  fir(250, 246, 1.5, "#37635a") }

return ground
