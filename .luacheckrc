std = "lua54"
max_line_length = 100
exclude_files = { "build*", "out", "lua/celspan.d.lua" }
files["tests/spec"] = { std = "+busted" }
files["tests/property"] = { std = "+busted" }
files["tests/golden/**/*_spec.lua"] = { std = "+busted" }
