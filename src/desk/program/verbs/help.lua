--- celspan help [VERB], and the manual page: both are made from the descriptions of the verbs.
local program, request = ...

local WIDTH = 100

local exit_codes = {
  { "0", "every requested frame exists" }, { "1", "some frames failed, or differ" },
  { "2", "wrong usage" }, { "3", "the script or its scene failed" },
  { "4", "an input is missing or damaged" }, { "5", "an output cannot be written" },
  { "6", "a limit was exceeded" }, { "33", "out of memory" }, { "70", "internal error" },
  { "128+n", "ended by signal n" },
}

local environment = {
  { "CELSPAN_PATH",
    "where require searches after the script's folder; scripts may read these folders" },
  { "CELSPAN_MEMORY", "the memory that the run may use, such as 4G, if there is more" },
  { "CELSPAN_PICTURE_MODULE",
    "the file of the module celspan-picture.so, if celspan does not find it" },
  { "CELSPAN_TYPE_MODULE", "the same for celspan-type.so: type, drawings, paintings" },
  { "CELSPAN_COLOUR_MODULE", "the same for celspan-colour.so: colour profiles" },
  { "CELSPAN_SPACE_MODULE", "the same for celspan-space.so: spaces of OpenColorIO" },
  { "CELSPAN_PDF_MODULE", "the same for celspan-pdf.so: drawings as PDF" },
  { "CELSPAN_WEB_MODULE", "the same for celspan-web.so: watch and play" },
  { "OCIO", "an OpenColorIO configuration: its spaces may be named in colour and --colour" },
}

local verbs = program.verbs()

--- The words after a verb on a command line.
local function usage_of(verb)
  return verb.operands .. " [options]" .. (verb.has_script and " [-- ARGS]" or "")
end

-- ---------------------------------------------------------------- help

--- A text in lines, all of which except the first begin with an indent. Lines that begin with a
--- space are not changed.
local function wrapped(text, indent)
  local lines = {}
  for paragraph in text:gmatch "[^\n]+" do
    local line = paragraph:sub(1, 1) == " " and paragraph
    for word in (line and "" or paragraph):gmatch "%S+" do
      if not line then
        line = word
      elseif indent + #line + 1 + #word > WIDTH then
        lines[#lines + 1], line = line, word
      else
        line = line .. " " .. word
      end
    end
    lines[#lines + 1] = line
  end
  return table.concat(lines, "\n" .. (" "):rep(indent))
end

-- ---------------------------------------------------------------- the formats of outputs

local function has(list, wanted)
  for _, word in ipairs(list) do if word == wanted then return true end end
  return false
end

--- Rows of files by their kind, in the order of the table: { kind, "mp4, mkv, ..." }.
local function kinds_of(is_wanted)
  local kinds = {}
  for _, output in ipairs(program.outputs()) do
    local last, names = kinds[#kinds], table.concat(output.names, ", ")
    if output.kind ~= "digests" and is_wanted(output) then
      if last and last[1] == output.kind then
        last[2] = last[2] .. ", " .. names
      else
        kinds[#kinds + 1] = { output.kind, names }
      end
    end
  end
  return kinds
end

--- The kinds that a verb makes. Only verbs that take names of formats make such files.
local function formats_of(verb)
  local has_format = false
  for _, option in ipairs(verb.options) do has_format = has_format or option.is_format end
  return kinds_of(function(output)
    return has_format and (not output.makers or has(output.makers, verb.name))
  end)
end

--- The tables of docs/formats.md: the formats by their kinds, and which of them take the options
--- that some do not take.
local function put_formats(out)
  local rows, known, all = {}, {}, kinds_of(function() return true end)
  out:write "| kind | formats |\n|---|---|\n"
  for _, kind in ipairs(all) do
    out:write(("| %s | %s |\n"):format(kind[1], kind[2]))
    all[kind[1]] = kind[2]
  end
  for _, output in ipairs(program.outputs()) do
    for _, option in ipairs(output.takes) do
      local words = {}
      for i, kind in ipairs(kinds_of(function(other) return has(other.takes, option) end)) do
        words[i] = all[kind[1]] == kind[2] and kind[1] or ("%s (%s)"):format(kind[1], kind[2])
      end
      local takers = table.concat(words, ", ")
      if not known[takers] then
        rows[#rows + 1] = { takers }
        known[takers] = rows[#rows]
      end
      local options = known[takers]
      if not known[option] then options[#options + 1] = "`" .. option .. "`" end
      known[option] = true
    end
  end
  out:write "\n| options | only for |\n|---|---|\n"
  for _, row in ipairs(rows) do
    out:write(("| %s | %s |\n"):format(table.concat(row, ", ", 2), row[1]))
  end
end

local function put_verb(out, verb)
  out:write(("celspan %s %s\n\n%s\n"):format(verb.name, usage_of(verb), verb.summary))
  if verb.notes then out:write("\n", wrapped(verb.notes, 0), "\n") end
  if verb.options[1] then out:write "\nOptions\n" end
  for _, option in ipairs(verb.options) do
    local words = option.name .. " " .. (option.value or "")
    out:write(("  %-18s%s%s\n"):format(words, #words > 18 and option.value and "  " or " ",
      wrapped(option.help, 21)))
  end
  local formats = formats_of(verb)
  if formats[1] then out:write "\nFormats of OUT, by the ending of its name\n" end
  for _, kind in ipairs(formats) do out:write(("  %-18s %s\n"):format(kind[1], kind[2])) end
  if verb.has_script then
    out:write "\nThe words after -- are the arguments (...) of the script.\n"
  end
end

--- Writes a verb of the list: its operands in a column, or on a separate line if they are too long.
local function put_row(out, name, operands, summary)
  local gap = #operands > 19 and "\n" .. (" "):rep(31) or " "
  out:write(("  %-8s %-19s%s%s\n"):format(name, operands, gap, wrapped(summary, 31)))
end

local FIRST = [[
celspan %s - 2D animation from Lua scripts: films, videos, frames

The first film
  celspan init first                       makes a folder with a film of six seconds
  cd first
  celspan watch film.lua                   shows it in the browser while you change it
  celspan render film.lua -o out/film.mp4  makes a video of it

celspan VERB ...
]]

local function put_list(out)
  out:write(FIRST:format(program.version))
  for _, verb in ipairs(verbs) do put_row(out, verb.name, verb.operands, verb.summary) end
  put_row(out, "help", "VERB|lua [NAME]", "Describes a verb, or a name of the Lua interface.")
  put_row(out, "", "WORDS", "Shows how to make a thing, such as shadow, wipe or typewriter.")
  out:write("\ncelspan --version prints the version, celspan --man the manual page.\n\n"
    .. "Exit codes\n")
  local half = (#exit_codes + 1) // 2 -- two columns; each is filled from top to bottom
  for i = 1, half do
    local left, right = exit_codes[i], exit_codes[i + half]
    out:write(("  %-3s %-33s %-6s %s\n"):format(left[1], left[2], right[1], right[2]))
  end
end

-- ---------------------------------------------------------------- the search

local SHOWN = 3

-- Folders of celspan's scripts that recipes read; scenery in `stage` reads the others.
local FOLDERS = { '"drawings/', '"pictures/', '"stage[./]', '"type/' }
local COPIED = ", and copy the folders drawings, pictures, stage and type beside it, from scripts "
  .. "of the source or share/celspan/examples"

--- How a recipe is saved and run.
local function use_of(recipe)
  local is_beside = false
  for _, folder in ipairs(FOLDERS) do is_beside = is_beside or recipe.page:find(folder) end
  local fonts = recipe.page:find("--allow-system-fonts", 1, true) and " --allow-system-fonts"
  local run = recipe.page:find("lua5.4 " .. recipe.name, 1, true) and "'lua5.4 NAME.lua' runs it."
    or "'celspan play NAME.luaFONTS' shows it, and 'celspan render NAME.lua -o NAME.mp4FONTS' "
      .. "makes a video."
  local text = "Save it as NAME.lua" .. (is_beside and COPIED or "") .. ". " .. run
  return wrapped((text:gsub("%u+", { NAME = recipe.name, FONTS = fonts or "" })), 0) .. "\n"
end

local function put_recipe(out, recipe)
  out:write(recipe.title, "\n\n", recipe.page, "\n\n", use_of(recipe))
end

local function put_recipes(out, recipes)
  out:write "celspan help WORD shows one of these:\n\n"
  for _, recipe in ipairs(recipes) do
    out:write(("  %-36s %s\n"):format(recipe.title,
      wrapped(table.concat(recipe.keywords, ", "), 39)))
  end
end

--- Words in the form for comparisons: paper_cutout, Cross-hatching.
local function alike(words) return (words:lower():gsub("[-_]", " ")) end

--- The recipe with this title or keyword, if there is exactly one, and the words do not first mean
--- something else.
local function exact_recipe(recipes, words)
  local found, wanted = {}, alike(words)
  for _, row in ipairs(program.part "synonyms.lua") do
    if row.is_first and row[1] == wanted then return nil end
  end
  for _, recipe in ipairs(recipes) do
    local is_it = alike(recipe.title) == wanted
    for _, keyword in ipairs(recipe.keywords) do is_it = is_it or alike(keyword) == wanted end
    if is_it then found[#found + 1] = recipe end
  end
  return #found == 1 and found[1] or nil
end

--- Writes what the words may mean: recipes, chapters, names and verbs.
local function put_nearest(out, recipes, words)
  local topics = program.part("topics.lua", recipes, program.text "headings.txt",
    require "celspan.manual".names(), verbs)
  local find = program.part("search.lua", require "celspan.native".nearest,
    program.part "synonyms.lua")
  local found = find(topics, words, SHOWN)
  if words:find "^celspan_[%w_]+$" then
    out:write(words, " is a name of C: celspan.h and the other headers in include/celspan say what "
      .. "it does, and docs/c.md introduces them.\n")
  end
  if #found == 0 then
    program.usage("there is nothing about '%s'; celspan help lists the verbs, celspan help "
      .. "cookbook the tasks, and celspan help lua the names", words)
  end
  out:write(("The nearest to '%s':\n"):format(words))
  for _, topic in ipairs(found) do
    out:write("\n  ", topic.title, "\n")
    if topic.about ~= "" then out:write("    ", wrapped(topic.about, 4), "\n") end
    out:write("    ", topic.read, "\n")
  end
end

--- Writes about a verb, about a name of Lua after the word lua, or the best matches for the words.
local function put_about(out, words)
  local name = words:match "^lua%f[%z ] *(.*)$"
  for _, verb in ipairs(verbs) do
    if verb.name == words then return put_verb(out, verb) end
  end
  if name then
    local page = require "celspan.manual".page(name ~= "" and name or nil)
    if page then return out:write(page) end
  end
  local recipes = program.part("recipes.lua", program.text "cookbook.md")
  local recipe = exact_recipe(recipes, words)
  if words == "cookbook" then
    put_recipes(out, recipes)
  elseif words == "formats" then
    put_formats(out)
  elseif words == "assistants" then
    out:write(program.text "assistants.md")
  elseif recipe then
    put_recipe(out, recipe)
  else
    put_nearest(out, recipes, name or words)
  end
end

-- ---------------------------------------------------------------- the manual page

local escapes = { ["-"] = "\\-", ["\\"] = "\\e", ["^"] = "\\(ha", ["~"] = "\\(ti", ["`"] = "\\(ga" }

--- A text without requests or escapes for roff; every run of blanks becomes one blank.
local function roff(text)
  return (text:gsub("[-\\^~`]", escapes):gsub("%s+", " "):gsub("^[.']", "\\&%0"))
end

local function put_notes(out, notes)
  local is_plain = true
  for line in notes:gmatch "[^\n]+" do
    local is_indented = line:sub(1, 1) == " "
    if is_indented == is_plain then out:write(is_indented and ".PP\n.nf\n" or ".fi\n.PP\n") end
    is_plain = not is_indented
    out:write(roff(line), "\n")
  end
  if not is_plain then out:write ".fi\n" end
end

local function put_term(out, name, meaning)
  out:write(".TP\n", name, "\n", roff(meaning), "\n")
end

local function put_section(out, verb)
  out:write(".SS celspan ", verb.name, " ", roff(usage_of(verb)), "\n", roff(verb.summary), "\n")
  if verb.notes then
    out:write ".PP\n"
    put_notes(out, verb.notes)
  end
  for _, option in ipairs(verb.options) do
    local value = option.value and (" \\fI%s\\fR"):format(roff(option.value)) or ""
    put_term(out, ("\\fB%s\\fR%s"):format(roff(option.name), value), option.help)
  end
  local formats = formats_of(verb)
  for i, kind in ipairs(formats) do formats[i] = ("%s: %s."):format(kind[1], kind[2]) end
  if formats[1] then
    out:write(".PP\nFormats of OUT. ", roff(table.concat(formats, " ")), "\n")
  end
end

local HEAD = [[
.TH CELSPAN 1 "" "celspan @VERSION@" "User Commands"
.nh
.SH NAME
celspan \- 2D animation from Lua scripts: films, videos, frames
.SH SYNOPSIS
.B celspan
.I VERB
.RI [ operands ]
.RI [ options ]
.RB [ \-\-
.IR ARGS ]
.br
.B celspan help
.RI [ VERB | WORDS ]
.br
.B celspan help lua
.RI [ NAME ]
.br
.B celspan \-\-version
.br
.B celspan \-\-man
.SH DESCRIPTION
A Lua script describes a film frame by frame; celspan turns the frames into files.
.PP
Options may come before or after the operands; a value follows its option after a space
or an equals sign. The words after \-\- are the arguments of the script.
Diagnostics go to standard error.
.PP
\-\-man prints this page.
.SH VERBS
]]

local function put_manual(out)
  out:write((HEAD:gsub("@VERSION@", program.version)))
  for _, verb in ipairs(verbs) do put_section(out, verb) end
  out:write ".SH EXIT STATUS\n"
  for _, code in ipairs(exit_codes) do put_term(out, ".B " .. roff(code[1]), code[2]) end
  out:write ".SH ENVIRONMENT\n"
  for _, variable in ipairs(environment) do put_term(out, ".B " .. variable[1], variable[2]) end
end

-- ---------------------------------------------------------------- for programs

--- Rows { name, meaning } as a list of objects.
local function rows_of(rows)
  local list = {}
  for i, row in ipairs(rows) do list[i] = { name = row[1], about = row[2] } end
  return { list = list }
end

--- The rows of outputs, whose lists may be empty.
local function lists_of(outputs)
  for _, output in ipairs(outputs) do
    for _, name in ipairs { "names", "takes", "makers" } do
      output[name] = output[name] and { list = output[name] }
    end
  end
  return outputs
end

--- Writes everything that the help knows, as one object.
local function put_json(out)
  for _, verb in ipairs(verbs) do verb.options = { list = verb.options } end
  out:write(program.json { version = program.version, verbs = verbs,
    outputs = { list = lists_of(program.outputs()) },
    exit_codes = rows_of(exit_codes), environment = rows_of(environment),
    lua = require "celspan.manual".facts() }, "\n")
end

if request[1] and (request.man or request.completion or request.json) then
  program.usage("--man, --completion and --json print all: leave '%s' out", request[1])
end
if request.man then
  put_manual(io.stdout)
elseif request.completion then
  local formats = {}
  for _, verb in ipairs(verbs) do
    local names = {}
    for i, kind in ipairs(formats_of(verb)) do names[i] = kind[2]:gsub(",", "") end
    formats[verb.name] = table.concat(names, " "):gsub("^%- ", "")
  end
  local text = program.part("completion.lua", verbs, request.completion, formats)
  if not text then
    program.usage("--completion: '%s' is not bash, zsh or fish", request.completion)
  end
  io.write(text)
elseif request.json then
  put_json(io.stdout)
elseif request[1] then
  put_about(io.stdout, table.concat(request, " "))
else
  put_list(request.stderr and io.stderr or io.stdout)
end
