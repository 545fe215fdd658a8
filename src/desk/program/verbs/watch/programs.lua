--- The programs that celspan watch starts for the user: the browser and the editor.
--
-- INVARIANT: none is started through a shell. The token is in no command line, which everybody on
-- this machine can read, and the editor gets no text that a script has chosen but the absolute path
-- of a file, which is no option whatever the file is called.
local program, request = ...

local programs = {}

local running = {} -- processes

--- true | nil, message
local function launch(words, is_silent)
  local process, message = program.launch(words, is_silent)
  if not process then return nil, message end
  running[process] = true
  return true
end

--- Forgets programs that have ended.
function programs.step()
  for process in pairs(running) do
    if program.has_ended(process) then running[process] = nil end
  end
end

-- ---------------------------------------------------------------- the editor

--- The path, made absolute.
local function from_root(path)
  if path:sub(1, 1) == "/" then return path end
  return program.working_folder():gsub("/$", "") .. "/" .. path
end

--- Opens a line of a file in the editor of --editor. true | nil, message
function programs.edit(path, line)
  local words, parts = {}, { file = from_root(path), line = ("%d"):format(line) }
  for word in request.editor:gmatch "%S+" do
    words[#words + 1] = word:gsub("{(%l+)}", parts)
  end
  return launch(words)
end

-- ---------------------------------------------------------------- the browser

local PAGE = '<!doctype html><meta charset="utf-8"><title>celspan</title>'
  .. '<meta http-equiv="refresh" content="0; url=%s"><a href="%s">The film</a>\n'

--- Removes the page that leads to the address.
function programs.close() end

--- Opens the browser at an address by way of a file, which only this user can read.
function programs.browse(address)
  local file, remove = program.save_apart("open.html", PAGE:format(address, address))
  if not file then return program.note("%s: open the address yourself", remove) end
  programs.close = remove
  if not launch({ "xdg-open", file }, true) then
    program.note "there is no program xdg-open: open the address yourself"
  end
end

return programs
