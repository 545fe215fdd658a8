--- celspan sheet FILE|SCRIPT: an exposure sheet, or the sheet of a film, as text, converted, or on
--- paper; or the edit list of a film.
local program, request = ...
local files = require "celspan.files"
local json = require "celspan.json"
local ordered = require "celspan.ordered"
local sheet = require "celspan.sheet"

local input, output = request[1], request.output
local own_name = input:match "[^/]*$":gsub("%.[^.]*$", "")
local is_edit = output and program.has_ending(output, ".otio", ".edl")
local is_script = request.script or program.has_ending(input, ".lua")

--- The marks of a layer, in the order of the frames.
local function marks_of(made, layer)
  local list = {}
  for frame, marks in pairs(made:marks(layer)) do
    list[#list + 1] = { frame = frame, marks = ordered.names(marks) }
  end
  return ordered.sort(list, "frame")
end

--- The facts of a sheet, for other programs.
local function facts_of(made)
  local layers = {}
  for i, name in ipairs(made.layers) do
    layers[i] = { name = name, changes = { list = made:changes(i) },
                  marks = { list = marks_of(made, i) } }
  end
  return { name = made.name, scene = made.scene, cut = made.cut, fps = made.fps,
           frames = made.frames, size = made.width and { made.width, made.height },
           layers = { list = layers }, notes = { list = made.notes } }
end

--- Writes the edit list of a film.
local function write_edit(script)
  local folders = output:find "^/" and "" or output:gsub("[^/]*$", ""):gsub("%./", "")
  local text = script:ask("celspan.edits", "text", json.encode({ form = output:lower():match "%w+$",
    media = request.media, name = own_name, up = folders:gsub("[^/]+/+", "../") },
    { plain = true }))
  if text:find "^-" then program.fail("input", "%s: %s", output, text:sub(2)) end
  local list = { write = function(_, path) return files.write(path, text:sub(2)) end }
  return program.put(list, output, request[1])
end

--- The file of the letters, and a function that removes it if it is there for this time alone.
local function font_file()
  if request.font then return program.resolve(request.font), function() end end
  local folder = output:match "^.*/" or "."
  local path, remove = program.save_apart("block.ttf", program.text "block.ttf", folder)
  return path or program.fail("output", "%s", remove), remove
end

--- Writes the sheet on paper, with what a film adds to it.
local function print_sheet(made, script)
  local title = made.name ~= "" and made.name or own_name
  local notes = script and program.part("shooting.lua", program, script,
    request.frames and script:numbers()) or {}
  program.make_folders(output)
  local font, remove = font_file()
  local is_made, fault = pcall(function()
    local pages = program.part("paper.lua", program, request, made)
    program.pages(pages(title, font, notes), output)
  end)
  remove()
  if not is_made then error(fault, 0) end
end

local function refuse_if(is_wrong, ...)
  if is_wrong then program.usage(...) end
end

local is_paper = output and program.has_ending(output, ".pdf")
local is_sheet = not output or output == "-" or program.has_ending(output, ".xdts", ".csv", ".txt")
refuse_if(not (is_sheet or is_edit or is_paper),
  "-o: '%s' must end in .xdts, .csv, .txt, .otio, .edl or .pdf", output)
refuse_if(is_edit and (request.frames or not is_script),
  "-o: %s is an edit list, which is made of a script, of all its frames", output)
refuse_if(request.media and not is_edit,
  "--media goes with an edit list: -o cut.otio or cut.edl")
refuse_if(request.media and request.media:gsub("{name}", ""):find "[{}]",
  "--media: '%s': only {name} goes in braces, for the name of the shot", request.media)
refuse_if((request.paper or request.font) and not is_paper,
  "--paper and --font go with a sheet on paper: -o cut.pdf")
if request.font and program.entries(request.font) ~= false then
  program.fail("input", "%s: is not a file; --font takes a font", request.font)
end
refuse_if(request.paper and request.paper ~= "a4" and request.paper ~= "a3",
  "--paper: '%s' is not a4 or a3", request.paper)
refuse_if(output and request.json, "--json goes to standard output: leave -o out")
refuse_if(request.frames and not is_script, "--frames goes with a script, and %s is a sheet", input)
if not is_script then program.refuse_rights() end

local script = is_script and program.script()
if is_edit then return write_edit(script) end
if script then
  script:kept("celspan.shots", "mark", "on") -- the parts of a shot have its name
  script:ask("celspan.scenes", "rest", "on") -- a camera moves no drawing
end
local made = script and sheet.of(script, request.frames and { frames = script:numbers() })
  or program.input(sheet.read(input))
if is_paper then return print_sheet(made, script) end
if request.json then return print(program.json(facts_of(made))) end
if output and program.has_ending(output, ".csv") and not made.width then
  program.note("%s has no size: %s says 1920 x 1080", input, output)
end
program.put(made, output, input)
