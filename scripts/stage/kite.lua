local kite = union {
  path { d = "M0 -70 L46 0 L0 78 L-46 0 Z", fill = "#f2b632" },
  path { d = "M0 -70 L46 0 H0 Z", fill = "#e4572e" },
  path { d = "M0 78 L-46 0 H0 Z", fill = "#2a9d8f" } }
local tail = stroke { d = "M0 78 C34 104 -26 124 12 156", width = 3, cap = "round",
  fill = "#f7f3e3" }

return kite | tail
