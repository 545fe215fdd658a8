--- Services that are written in Lua. They are loaded when a verb asks for the first of them.
local program = ...

program.path_most = 4095 -- the most bytes of the name of a file

--- Refuses an output that is the plane which is read: it would be lost.
function program.refuse_self(input, output)
  local is_file = program.entries(input) == false -- a path that does not exist leads to its folder
  if is_file and program.resolve(input) == program.resolve(output) then
    program.usage("%s: the output is the plane that is read: give another name", output)
  end
end

--- Whether a path has one of these endings, in upper or lower case.
function program.has_ending(path, ...)
  for _, ending in ipairs { ... } do
    if #path > #ending and path:sub(-#ending):lower() == ending then return true end
  end
  return false
end

--- The bytes of a file; if it cannot be read, the verb ends.
function program.bytes(path)
  local file, message = io.open(path, "rb")
  local bytes = file and file:read "a"
  if file then file:close() end
  return bytes or program.fail("input", "%s", message or path)
end

--- Whether a path is a folder, or leads into it. Both are resolved.
function program.is_within(folder, path)
  return path == folder or path:sub(1, #folder + 1) == folder:gsub("/$", "") .. "/"
end

--- A frame of a film as a separate film in which it looks the same: for celspan.pixels,
--- celspan.probe and program.write.
function program.still(script, exposures)
  return require "celspan".film { size = script.size, space = script.space,
    frame = function() return exposures end }
end

--- The camera of a frame, which is built: x, y and width, nil where they are those of the whole
--- film, and turn, clockwise in radians; nil: the frame has none.
function program.camera(script, number)
  script:build(number)
  local has_centre, has_width, x, y, width, turn =
    script:camera():match "^(%d),(%d),([^,]+),([^,]+),([^,]+),([^,]+)$"
  if not turn then return nil end
  local is_placed, is_sized = has_centre == "1", has_width == "1"
  return { x = is_placed and tonumber(x) or nil, y = is_placed and tonumber(y) or nil,
           width = is_sized and tonumber(width) or nil, turn = tonumber(turn) }
end

--- What a verb reads for functions that take pictures, and its size: the name of a picture's file;
--- otherwise a celspan.picture that shows the input.
function program.pictured(path)
  local kind = program.kind(path)
  local is_film = kind == "script" or kind == "lottie"
  if kind == "picture" or is_film or kind == "folder" then return path end
  local shown = program.shown(path)
  local pixels, alpha = shown:pixels(path)
  local picture = require "celspan".picture { pixels = pixels,
    size = { shown.width, shown.height }, format = "rgba16" }
  return picture, { width = shown.width, height = shown.height, alpha = alpha or nil }
end

--- The parts of a text between commas.
function program.split(text)
  local list = {}
  for part in (text .. ","):gmatch "([^,]*)," do list[#list + 1] = part end
  return list
end

--- The pigment of an opaque colour such as "#ffe0b0"; nil for another text.
function program.colour(text)
  local good, paint = pcall(require "celspan".rgb, text:match "^#.*")
  return good and paint.beta == 1 and paint.pigment or nil
end

--- The whole numbers in a text such as "1,2,30,40".
function program.numbers(text)
  local list = {}
  for number in text:gmatch "[+-]?%d+" do list[#list + 1] = math.tointeger(number) end
  return list
end

--- The file and the line that a sentence about a script mentions; nil: none.
function program.place_of(sentence)
  local path, line = sentence:match "^([^:\n]+):(%d+): "
  if not path then path, line = sentence:match "%(([^():\n]+):(%d+)%)" end
  return path, math.tointeger(line)
end

--- A text; if it is not UTF-8, with question marks for all bytes beyond ASCII.
function program.utf8(text) return utf8.len(text) and text or (text:gsub("[\x80-\xff]", "?")) end

local PLAIN = { plain = true, value = function(one)
  return type(one) == "string" and require "celspan.json".encode(program.utf8(one)) or nil
end }

--- A value as JSON: tables with a field `list`, or with items, become lists; other tables become
--- objects.
function program.json(value) return require "celspan.json".encode(value, PLAIN) end

local ENTITIES = { ["&"] = "&amp;", ["<"] = "&lt;", [">"] = "&gt;", ['"'] = "&quot;" }

--- A text in the form that HTML and XML have for it, also in attributes.
function program.markup(text) return (text:gsub('[&<>"]', ENTITIES)) end

--- The message for a frame function that returns another scene when it is called again.
program.impure = "the frame function is not pure: called again, it returned another scene; let it "
  .. "depend on its argument alone, not on a counter outside it or on # of a table with holes"

local AGAIN_LEAST, AGAIN_PART = 9, 10

--- Which of `count` frames are built again in each of `states` fresh films: lists of their places,
--- the last place first. All lists together have one place in every AGAIN_PART, and at least
--- AGAIN_LEAST. The choice depends on the count alone, so it is the same each time. If there are
--- fewer frames, they are in several lists. A single frame is in each list twice; otherwise a
--- counter would not be found.
function program.sample(count, states)
  local share = math.ceil(math.max(AGAIN_LEAST, count / AGAIN_PART) / states)
  local parts = math.min(count, share) * states
  local lists = {}
  math.randomseed(count)
  for i = 1, states do lists[i] = {} end
  for part = parts, 1, -1 do
    local first = (part - 1) * count // parts + 1
    local place = math.random(first, math.max(first, part * count // parts))
    table.insert(lists[part % states + 1], place)
  end
  for i = 1, count == 1 and states or 0 do table.insert(lists[i], 1) end
  return lists
end

--- The message for a script that returns another film when it is run again.
function program.other_frames(fresh, script)
  return ("the script returned a film with other frames when it was run again: %d from number %d, "
    .. "not %d from number %d; let it return the same film each time"):format(fresh.frames,
    fresh.first, script.frames, script.first)
end

--- Lets a document write itself to a file, or writes its text to standard output. subject: the
--- input that it was made from, for messages.
function program.put(document, output, subject)
  if output and output ~= "-" then
    program.make_folders(output)
    local done, message = document:write(output)
    return done or program.fail("output", "%s", message)
  end
  local text, message = document:text()
  if not text then program.fail("limit", "%s: %s", subject, message) end
  io.stdout:write(text)
end

--- Adds the words that the request gives to the command of a process of this program: the options
--- that `own` does not name, --set for each of `settings`, { name, value }, and the script's
--- arguments.
function program.pass_on(words, request, own, settings)
  local function add(...) table.move({ ... }, 1, select("#", ...), #words + 1, words) end
  for _, option in ipairs(request.given) do
    if not own[option.name] then add(option.name, option.value) end
  end
  for _, one in ipairs(settings) do add("--set", one[1] .. "=" .. one[2]) end
  if #request.arguments > 0 then add("--", table.unpack(request.arguments)) end
  return words
end

--- Calls a function. A signal to stop makes what it draws fail: then it returns nothing, because
--- the verb ends with its results so far.
function program.until_stopped(call, ...)
  local results = table.pack(pcall(call, ...))
  if not results[1] and not program.is_stopped() then error(results[2], 0) end
  if results[1] then return table.unpack(results, 2, results.n) end
end

--- Runs processes, as many at a time as `workers`. next_item() returns the next item, or nil after
--- the last. start(item) returns its process, or nil and its exit code if it needs none, or nil if
--- it could not be started; then no more processes are started. finish(item, code, signal, name) is
--- called in the order of the items, and returns false to start no more. Returns how many were
--- finished, and whether all could be started.
function program.run_all(next_item, workers, start, finish)
  local by_process, ended, items = {}, {}, {}
  local running, started, finished, is_well, goes_on = 0, 0, 0, true, true
  program.divide_memory(workers)
  local item = next_item()
  while running > 0 or item do
    if program.is_stopped() or not goes_on then item = nil end
    if item and running < workers then
      local process, code = start(item)
      if process or code then
        started = started + 1
        items[started], ended[started] = item, code and { nil, code }
        if process then by_process[process], running = started, running + 1 end
        item = next_item()
      else
        item, is_well = nil, false
      end
    elseif running > 0 then
      local one = table.pack(program.wait())
      local place = by_process[one[1]]
      if not one[1] then break end
      if place then ended[place], by_process[one[1]], running = one, nil, running - 1 end
    end
    while ended[finished + 1] do
      finished = finished + 1
      local answer = finish(items[finished], table.unpack(ended[finished], 2, 4))
      goes_on = goes_on and answer ~= false
      items[finished], ended[finished] = nil, nil
    end
  end
  return finished, is_well
end

--- 128 bits that nobody can guess, in hexadecimal digits.
function program.random()
  local file = assert(io.open("/dev/urandom", "rb"))
  local bytes = assert(file:read(16))
  file:close()
  return (bytes:gsub(".", function(byte) return ("%02x"):format(byte:byte()) end))
end

--- Writes a file into a new folder, both for this user alone: where such files are kept, or, as
--- this may be forbidden, in the folder `last`. Returns its path and a function that removes both;
--- nil and a message.
function program.save_apart(name, text, last)
  local bases, message = {}, nil
  for _, variable in ipairs { "XDG_RUNTIME_DIR", "TMPDIR" } do
    local base = os.getenv(variable)
    bases[#bases + 1] = base ~= "" and base or nil
  end
  table.insert(bases, "/tmp")
  table.insert(bases, last)
  for _, base in ipairs(bases) do
    local folder = ("%s/.celspan-%s"):format(base, program.random())
    local function remove()
      os.remove(folder .. "/" .. name)
      os.remove(folder)
    end
    local path, fault = program.save_private(folder, name, text)
    if path then return program.resolve(path), remove end
    message = fault
    remove()
  end
  return nil, message
end

--- Bytes as digits of base64 (RFC 4648).
function program.base64(bytes)
  return require("celspan.native").data(bytes):sub(#"data:;base64," + 1)
end
