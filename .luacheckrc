std = "lua54"
max_line_length = false -- tests/support/rooms.lua --columns checks the sources of all languages
exclude_files = { "build*", "out" }
files["tests/**/*_spec.lua"] = { std = "+busted" }
-- The spec of a new project uses the assertions of celspan.spec.
files["src/desk/program/verbs/project/*_spec.lua"] = { std = "+busted", ignore = { "143/assert" } }
