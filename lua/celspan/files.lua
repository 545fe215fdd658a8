--- Whole files: reads them up to a limit, and writes them so that only complete files appear.
local core = require "celspan.core"

local files = {}

local MOST_BYTES = 256 * 1024 * 1024 -- of a file that a script reads as text
local PIECE = 65536 -- bytes; read allocates the requested size before it knows the file's size

--- The text of an open file; of a file that is too long, enough to see that.
local function read_pieces(file, most)
  local pieces, size = {}, 0
  while size <= most do
    local piece, problem = file:read(PIECE)
    if problem then return nil, problem end
    if not piece then break end
    pieces[#pieces + 1] = piece
    size = size + #piece
  end
  return table.concat(pieces)
end

---@param path string
---@param most integer Bytes
---@return string? text
---@return string? message
function files.read(path, most)
  local file, message = io.open(path, "rb")
  if not file then return nil, message end
  local text, problem = read_pieces(file, most)
  file:close()
  if not text then return nil, ("%s: %s"):format(path, problem) end
  if #text > most then
    return nil, ("%s: it has more than %d bytes, which is the limit"):format(path, most)
  end
  return text
end

--- The same for a file named in a script: beside the caller's file, else beside the script.
---@param path string
---@param most integer Bytes
---@return string? text
---@return string? message
function files.read_found(path, most)
  local found_at, tried = core.find(path)
  local text, message = files.read(found_at, most)
  if text or not tried then return text, message end
  return nil, ("%s; also looked for at %s"):format(message, tried)
end

--- celspan.read: the text of a file named in a script.
function files.text(path)
  if type(path) ~= "string" then
    core.refuse("celspan: read takes a file name, got " .. type(path))
  end
  return files.read_found(path, MOST_BYTES)
end

---@param path string Relative to the current folder
---@param text string
---@return true? done
---@return string? message
function files.write(path, text)
  local part = path .. ".part"
  local file, message = io.open(part, "wb")
  if not file then return nil, message end
  local good, problem = file:write(text)
  local closed, unclosed = file:close()
  if not good or not closed then
    os.remove(part)
    return nil, ("%s: %s"):format(path, problem or unclosed)
  end
  good, problem = os.rename(part, path)
  if not good then os.remove(part) end
  return good, problem
end

return require "celspan.fields".publish("files", files)
