std = "lua54"
max_line_length = false -- tests/support/rooms.lua --columns checks the sources of all languages
exclude_files = { "build*", "out" }
files["tests/**/*_spec.lua"] = { std = "+busted" }
-- The spec of a new project uses the assertions of celspan.spec.
files["src/desk/program/verbs/project/*_spec.lua"] = { std = "+busted", ignore = { "143/assert" } }
-- In scripts that the program runs, the names of the library are global.
for _, folder in ipairs { "scripts", "docs/pictures", "packaging/examples", "tests/page",
                          "src/desk/program/verbs/project" } do
  files[folder .. "/**/*.lua"] = { ignore = { "113" } }
end
