local car = union {
  path {
    d = "M-90 0 L-84 -30 L-40 -34 L-26 -64 H34 L48 -34 L86 -28 L90 0 Z",
    fill = "#3a3a3a" },
  path { d = "M-30 -36 L-19 -58 H4 V-36 Z M10 -36 V-58 H29 L40 -36 Z", fill = "#d9d9d9" },
  circle { -50, 0, 19, fill = "#1d1d1d" },
  circle { 54, 0, 19, fill = "#1d1d1d" },
  circle { -50, 0, 8, fill = "#b5b5b5" },
  circle { 54, 0, 8, fill = "#b5b5b5" } }
local houses = {}
for i = 0, 9 do
  local h = 60 + 50 * random "house"(i)
  houses[i + 1] = rect {
    90 * i - 90, 190 - h, 84, h,
    fill = i % 2 == 0 and "#9a9a9a" or "#b4b4b4" }
    | path {
      d = ("M%g %g l47 -34 l47 34 Z"):format(90 * i - 95, 191 - h),
      fill = "#6f6f6f" }
end

return { car = car, houses = houses }
