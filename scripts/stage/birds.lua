local function bird(colour, belly, side)
  return (ellipse { 0, 0, 44, 50, fill = colour }
     | ellipse { 8, 14, 28, 32, fill = belly }
     | circle { 16, -18, 10, fill = "#fff" }
     | circle { 19, -18, 4.5, fill = "#22202a" }
     | path { d = "M36 -14 L62 -4 L36 4 Z", fill = "#f2a33a" }
     | path { d = "M-10 -48 C-14 -66 2 -66 0 -50 C6 -66 20 -60 10 -46 Z", fill = colour }
     | stroke { d = "M-10 48 V66 M10 48 V66", width = 5, fill = "#e08a2c" })
    :scale(side, 1)
end

return bird
