--- celspan sheet FILE|SCRIPT: an exposure sheet, or the sheet of a film, as text, converted, or on
--- paper; or the edit list of a film.
local program, request = ...
local files = require "celspan.files"
local json = require "celspan.json"
local ordered = require "celspan.ordered"
local sheet = require "celspan.sheet"

local input, output = request[1], request.output
local is_edit = output and program.has_ending(output, ".otio", ".edl")
local is_script = request.script or program.has_ending(input, ".lua")

--- The marks of a layer, in the order of the frames.
local function marks_of(made, layer)
  local list = {}
  for frame, marks in pairs(made:marks(layer)) do
    local names = ordered.names(marks)
    if #names > 0 then list[#list + 1] = { frame = frame, marks = names } end
  end
  table.sort(list, function(a, b) return a.frame < b.frame end)
  return list
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
    media = request.media, up = folders:gsub("[^/]+/+", "../") }, { plain = true }))
  if text:find "^-" then program.fail("input", "%s: %s", output, text:sub(2)) end
  local list = { write = function(_, path) return files.write(path, text:sub(2)) end }
  return program.put(list, output, request[1])
end

--- What a film adds to its sheet on paper.
local function notes_of(script)
  local numbers = script and request.frames and script:numbers()
  return script and program.part("shooting.lua", program, script, numbers) or {}
end

--- Writes the sheet on paper. Its letters are for the time being in a file beside the output.
local function print_sheet(made, script)
  local title = made.name ~= "" and made.name or input:match "[^/]*$":gsub("%.[^.]*$", "")
  local font = request.font and program.resolve(request.font)
  local folder, name = output:match "^(.-)([^/]*)$"
  local own = not font and ("%s.%s.ttf"):format(folder, name:sub(1, 240))
  program.make_folders(output)
  if own then program.save(own, program.text "block.ttf") end
  local is_made, fault = pcall(function()
    local pages = program.part("paper.lua", program, request, made)
    program.pages(pages(title, font or program.resolve(own), notes_of(script)), output)
  end)
  if own then os.remove(own) end
  if not is_made then error(fault, 0) end
end

local is_paper = output and program.has_ending(output, ".pdf")
if output and output ~= "-" and not is_edit and not is_paper
  and not program.has_ending(output, ".xdts", ".csv", ".txt") then
  program.usage("-o: '%s' must end in .xdts, .csv, .txt, .otio, .edl or .pdf", output)
end
if is_edit and (request.frames or not is_script) then
  program.usage("-o: %s is an edit list, which is made of a script, of all its frames", output)
end
if request.media and not is_edit then
  program.usage "--media goes with an edit list: -o cut.otio or cut.edl"
end
if (request.paper or request.font) and not is_paper then
  program.usage "--paper and --font go with a sheet on paper: -o cut.pdf"
end
if request.font and program.entries(request.font) ~= false then
  program.fail("input", "%s: is not a file; --font takes a font", request.font)
end
if request.paper and request.paper ~= "a4" and request.paper ~= "a3" then
  program.usage("--paper: '%s' is not a4 or a3", request.paper)
end
if output and request.json then program.usage("--json goes to standard output: leave -o out") end
if request.frames and not is_script then
  program.usage("--frames goes with a script, and %s is a sheet", input)
end
if not is_script then program.refuse_rights() end

local script = is_script and program.script()
if is_edit then return write_edit(script) end
if script then script:kept("celspan.shots", "mark", "on") end -- the parts of a shot have its name
local made = script and sheet.of(script, request.frames and { frames = script:numbers() })
  or program.input(sheet.read(input))
if is_paper then return print_sheet(made, script) end
if request.json then return print(program.json(facts_of(made))) end
if output and program.has_ending(output, ".csv") and not made.width then
  program.note("%s has no size: %s says 1920 x 1080", input, output)
end
program.put(made, output, input)
