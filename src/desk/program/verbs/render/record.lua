--- The record of finished frames, in a file beside them: --resume relies on it. A file that holds
--- all frames, a video, planes or a sound, has a line for itself, as frame 0.
---
---   .shot.####.png.frames
---     celspan frames 1
---     by VERSION (COMMIT)                         of the program that adds the lines which follow
---     frame NUMBER KEY BYTES CONTENTS PIXELS      hashes as 32 hexadecimal digits; PIXELS may be -
---
--- KEY is the hash of everything that decides how a frame comes out: the scene, the files of its
--- pictures as they were, the view, the coding, the version; of a file of all frames also their
--- numbers, the sounds, the marks, the captions and the poster, but not the encoder. CONTENTS is
--- the hash of the file as it was written, taken before it got its name. What contains a procedure
--- can be compared with nothing, and is never kept.
---
--- A line is added when the file of its frame is complete under its name. Lines are only added,
--- each in one write, so that several runs may share a record. A line that was cut off is ignored;
--- of two lines about a frame, the later one counts. A record with another head, of another
--- version, is replaced.
local program, request, script, view = ...

local HEAD = "celspan frames 1\n"
local LINE = "^frame (%-?%d+) (%x+) (%d+) (%x+) (%S+)$"
local DIGITS = 32 -- digits of a hash
local PATH_MOST = 4111 -- bytes
local MISSING = { [2] = true, [20] = true } -- ENOENT, ENOTDIR
-- What decides how a file of all frames comes out, and is not in the options of its frames.
local OWN = { "codec", "quality", "crf", "fps", "loop", "max_size", "loudness", "background",
              "no_dither" }

local options = program.hash(table.concat({ program.maker, view, request.format or "",
  request.strip and "strip" or "", request.layers or "", request.cryptomatte or "",
  script.title or "", script.fps, script.frames > 1 and "film" or "still" }, "\n"))
local path = request.output:gsub("[^/]*$", ".%0.frames", 1)
local record, lines, keys, journal = {}, {}, {}, nil

local function read()
  local file, message, code = io.open(path, "rb")
  local text
  if file then
    text, message = file:read "a"
    file:close()
  end
  if not text and not MISSING[code] then
    program.fail("output", "%s: cannot read: %s", path, (message:gsub("^.*: ", "")))
  end
  if not text or text:sub(1, #HEAD) ~= HEAD then return end
  for line in text:gmatch "(frame [^\n]*)\n" do
    local number, key, _, contents, pixels = line:match(LINE)
    local is_digest = pixels == "-" or number and #pixels == DIGITS and not pixels:find "%X"
    if is_digest and #key == DIGITS and #contents == DIGITS then
      lines[math.tointeger(number)] = line
    end
  end
end

if #path > PATH_MOST then
  program.fail("output", "%.80s...: the name is too long", request.output)
end
read()

--- Whether the file of this key is kept: it equals the one that would be written now, or with
--- --force it is complete. Then also whether it shows the same, and its digest or nil.
local function keeps(number, file, key)
  local _, known, bytes, contents, pixels = (lines[number] or ""):match(LINE)
  local is_same = known ~= nil and known == key
  pixels = pixels ~= "-" and pixels or nil
  if not is_same and not request.force or request.hash and not pixels then return false end
  if known then
    local size, hash = program.contents(file)
    return size == math.tointeger(bytes) and hash == contents, is_same, pixels
  end
  local found = io.open(file, "rb")
  local size = found and found:seek "end" or 0
  if found then found:close() end
  return size > 0, is_same, pixels
end

--- Adds a line for a file that was made. Returns true, or nil and a message.
local function add(number, key, bytes, contents, digest)
  local line, good, message = ""
  if not journal then
    journal, message = program.journal(path, HEAD)
    if not journal then return nil, path .. ": cannot write: " .. message end
    line = "by " .. program.maker .. "\n"
  end
  line = ("%sframe %d %s %d %s %s\n"):format(line, number, key, bytes, contents,
    request.hash and digest or "-")
  good, message = journal(line)
  if good then return true end
  return nil, path .. ": cannot write: " .. message
end

-- ---------------------------------------------------------------- frames

--- For script:shoot.
function record.keeps(number, file, scene, inputs)
  keys[number] = program.hash(options .. (scene or "") .. inputs)
  return keeps(number, file, scene and keys[number])
end

function record.add(number, bytes, contents, digest)
  local key = keys[number]
  keys[number] = nil
  return add(number, key, bytes, contents, digest)
end

-- ---------------------------------------------------------------- a file of all frames

local whole -- the key of the film so far; nil: it contains a procedure

--- Whether the file may be kept; only then it is of use to know its key.
function record.knows_whole() return not request.hash and (request.force or lines[0] ~= nil) end

--- Begins the key of the file with these frames.
function record.begin_whole(numbers)
  local parts = { options, table.concat(numbers, " ") }
  local function add_part(part) parts[#parts + 1] = part end
  for _, name in ipairs(OWN) do add_part(tostring(request[name])) end
  for _, mark in ipairs(script.marks) do add_part(mark.frame .. " " .. mark.name) end
  add_part(script:captions())
  if script.has_sound then add_part(script:sounds_key()) end
  if script.has_poster then
    script:build(script.poster)
    add_part((script:scene() or "procedure") .. script:pictures_key())
  end
  for i, part in ipairs(parts) do parts[i] = #part .. ":" .. part end
  whole = program.hash(table.concat(parts))
end

--- Adds what a frame shows, in the order of the frames. Returns true.
function record.add_to_whole(scene, inputs)
  whole = whole and scene and program.hash(whole .. scene .. inputs)
  return true
end

function record.keeps_whole() return (keeps(0, request.output, whole)) end

function record.add_whole(bytes, contents)
  return add(0, whole or program.hash "", bytes, contents)
end

return record
