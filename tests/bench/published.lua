--- Blend2D's best times as published for the same kind of machine (2 cores of a Zen 5 EPYC with
--- AVX-512; antialiased, one thread, bands of 8-bit pixels), in seconds by scene and side. Debian
--- has no package of Blend2D, so it rarely runs here; on another machine this is a yardstick only.
local published = {}

published.shapes = {
  ["10"] = { [1024] = 0.000147, [4096] = 0.00146, [30000] = 0.052, [100000] = 0.6,
             [1000000] = 56.6 },
  ["100"] = { [1024] = 0.00203, [4096] = 0.0129, [30000] = 0.389, [100000] = 3.5, [1000000] = 357 },
  ["1000"] = { [1024] = 0.0201, [4096] = 0.124, [30000] = 3.62, [100000] = 31, [1000000] = 3182 },
  opaque = { [1024] = 0.0174, [4096] = 0.092, [30000] = 2.733 },
  faint = { [1024] = 0.021, [4096] = 0.123, [30000] = 3.6 },
  small = { [1024] = 0.019, [4096] = 0.053, [30000] = 0.465 },
}

published.pictures = { affine = 0.00884, shift = 0.00183 }

--- The paper's figures 13 and 14: seconds at 30,000 pixels a side on one processor of an SGI Origin
--- 2000. Its shapes follow a line, its pictures a square.
published.paper = { shapes = 8.5, all_pictures = 2600, geometry = 1300, side = 30000 }

return published
