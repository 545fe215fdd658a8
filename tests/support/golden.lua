-- Goldens: small scripts, and the text of their spans as a reference.
local present = require "tests.support.present"
local shipped = require "tests.support.shipped"
local system = require "tests.support.system"
local workbench = require "tests.support.workbench"

local golden = {}

local command = workbench.binary

--- Paths of the scripts, without ".lua", in order.
function golden.cases()
  local list = {}
  local pipe = assert(io.popen "ls tests/golden/*/*.lua")
  for path in pipe:lines() do list[#list + 1] = path:match "^(.*)%.lua$" end
  pipe:close()
  table.sort(list)
  return list
end

--- The script's current spans, with these rights instead of reading from the scripts that ship; or
--- nil and a message (celspan's own goes to standard error).
function golden.actual(case, rights)
  local pipe = assert(io.popen(("'%s' spans %s.lua %s"):format(command, case,
    rights or "--allow scripts")))
  local text = pipe:read "a"
  if pipe:close() then return text end
  return nil, "celspan spans " .. case .. ".lua failed"
end

--- The accepted text; nil if there is none.
function golden.expected(case)
  local file = io.open(case .. ".spans")
  if not file then return nil end
  local text = file:read "a"
  file:close()
  return text
end

-- ---------------------------------------------------------------- digests

--- The file of digests: blocks separated by empty lines. The first line of a block is the question,
--- the others are the answer: for `render SCRIPT ...` it is the output of `celspan render --hash`,
--- a line per frame; for `example NAME ...` the digest of the program's output.
golden.digests_path = "tests/golden/digests.txt"

--- The accepted digests, as a list of { question, answer }.
function golden.digests()
  local file = assert(io.open(golden.digests_path))
  local text, list = file:read "a", {}
  file:close()
  for question, answer in (text .. "\n"):gmatch "([^\n]+)\n(.-\n)\n" do
    list[#list + 1] = { question, answer }
  end
  return list
end

--- The lines of a shell command's output; nil and a message when it fails.
local function lines_of(asked)
  local lines, ended_well = system.lines(asked)
  if ended_well then return lines end
  return nil, asked .. " failed"
end

--- The digests of the frames in order: workers end in any order.
local function ask_render(arguments, program)
  local lines, message = lines_of(("'%s' render %s --hash --progress none")
    :format(program or command, arguments))
  if not lines then return nil, message end
  table.sort(lines, function(a, b) return tonumber(a:match "%S+") < tonumber(b:match "%S+") end)
  return table.concat(lines, "\n") .. "\n"
end

local function ask_example(arguments)
  local lines, message = lines_of(("'%s'/examples/example_%s | md5sum")
    :format(workbench.build, arguments))
  if not lines then return nil, message end
  return lines[1]:match "%x+" .. "\n"
end

--- The current answer to a question; nil and a message if it fails. program: another celspan that
--- is asked, unless the question is of an example.
function golden.answer(question, program)
  local kind, arguments = question:match "^(%S+) (.*)$"
  return (kind == "example" and ask_example or ask_render)(arguments, program)
end

--- Whether a question needs a module that was not built.
function golden.lacks_module(question)
  local script = question:match "^render (%S+)"
  if not script then return question:find "^example [pl]" and not present.type() end
  return shipped.lacks_module(script) or script:find "/text/" and not present.type()
end

--- The numbers of a film's first and last frame.
local function ends_of(script)
  local told = assert(lines_of(("'%s' info %s"):format(command, script)))
  local text = table.concat(told, "\n")
  return tonumber(text:match "first (%-?%d+)"), tonumber(text:match "last (%-?%d+)")
end

--- Representative frames of a film: the first, one in the middle, the last.
local function frames_of(script)
  local first, last = ends_of(script)
  if last - first < 2 then return ("%d-%d"):format(first, last) end
  return ("%d,%d,%d"):format(first, (first + last) // 2, last)
end

--- Every script that ships and every scene of the goldens, as { path, function that makes a
--- question }.
function golden.drawn()
  local list = {}
  for _, path in ipairs(shipped.scripts()) do
    list[#list + 1] = { path, function()
      local script = path .. shipped.options(path)
      return ("render %s --size 96x54 --frames %s"):format(script, frames_of(script))
    end }
  end
  for _, case in ipairs(golden.cases()) do
    local path = case .. ".lua"
    list[#list + 1] = { path, function() return ("render %s --allow scripts"):format(path) end }
  end
  return list
end

--- Questions for every script that ships, in frames so wide that loops of each width of the
--- processor's instructions have whole blocks and a rest; as floats, because codes show only one in
--- thousands of the last bits that differ.
function golden.wide()
  local list = {}
  for _, path in ipairs(shipped.scripts()) do
    local script = path .. shipped.options(path)
    local frames = ("%d-%d:19"):format(ends_of(script))
    list[#list + 1] = ("render %s --size 640x360 --depth float --frames %s"):format(script, frames)
  end
  return list
end

--- Those of golden.drawn() that no question of the list names.
function golden.unasked(digests)
  local is_asked, list = {}, {}
  for _, digest in ipairs(digests) do is_asked[digest[1]:match "^render (%S+)" or ""] = true end
  for _, drawn in ipairs(golden.drawn()) do
    if not is_asked[drawn[1]] then list[#list + 1] = drawn end
  end
  return list
end

--- The lines that differ between two texts, marked "- " for the old and "+ " for the new.
function golden.difference(old, new)
  local function split(text)
    local list, set = {}, {}
    for line in text:gmatch "[^\n]+" do
      list[#list + 1] = line
      set[line] = true
    end
    return list, set
  end
  local old_list, old_set = split(old)
  local new_list, new_set = split(new)
  local out = {}
  for _, line in ipairs(old_list) do
    if not new_set[line] then out[#out + 1] = "- " .. line end
  end
  for _, line in ipairs(new_list) do
    if not old_set[line] then out[#out + 1] = "+ " .. line end
  end
  return table.concat(out, "\n")
end

return golden
