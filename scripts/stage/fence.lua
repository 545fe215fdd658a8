local cat = union {
  path {
    d = "M-52 60 C-60 10 -40 -18 -34 -30 L-40 -66 L-14 -44 C-4 -47 4 -47 14 -44"
      .. " L40 -66 L34 -30 C40 -18 60 10 52 60 Z",
    fill = "#2d2a32" },
  path { d = "M46 56 C92 60 96 8 76 -8 C104 -2 110 76 46 72 Z", fill = "#2d2a32" },
  ellipse { -16, -20, 8, 10, fill = "#d7f25c" },
  ellipse { 16, -20, 8, 10, fill = "#d7f25c" },
  path { d = "M-4 -6 H4 L0 0 Z", fill = "#ff9a8b" } }
local fence = {}
for i = 0, 13 do
  fence[i + 1] = path {
    d = "M0 0 V120 H30 V0 L15 -16 Z",
    fill = i % 2 == 0 and "#c98f5a" or "#bd8350" }
    :translate(36 * i - 6, 178)
end

return { cat = cat, fence = fence }
