-- Goldens: small scripts and the text of their spans, which is the truth.
local golden = {}

local command = os.getenv "CELSPAN" or "build/celspan"

--- Paths of the scripts, without ".lua", in order.
function golden.cases()
  local list = {}
  local pipe = assert(io.popen "ls tests/golden/*/*.lua")
  for path in pipe:lines() do list[#list + 1] = path:match "^(.*)%.lua$" end
  pipe:close()
  table.sort(list)
  return list
end

--- What the script gives now; or nil and a message (celspan's own goes to standard error).
function golden.actual(case)
  local pipe = assert(io.popen(("%s spans %s.lua --allow scripts"):format(command, case)))
  local text = pipe:read "a"
  if pipe:close() then return text end
  return nil, "celspan spans " .. case .. ".lua failed"
end

--- Whether celspan was built without the module that sets type.
function golden.lacks_art()
  local pipe = assert(io.popen(command .. " check tests/golden/text/layout.lua --allow scripts 2>&1"))
  local text = pipe:read "a"
  pipe:close()
  return text:find("celspan-art.so", 1, true) ~= nil
end

--- What was accepted; nil when nothing was.
function golden.expected(case)
  local file = io.open(case .. ".spans")
  if not file then return nil end
  local text = file:read "a"
  file:close()
  return text
end

--- Files of digests of a shipped film's frames, in order. The first line of such a file is what
--- `celspan render --hash` is asked for, the others are its answer.
function golden.films()
  local list = {}
  local pipe = assert(io.popen "ls tests/golden/*.digests")
  for path in pipe:lines() do list[#list + 1] = path end
  pipe:close()
  return list
end

--- What a file of digests says; and what it would say now, or nil and a message.
function golden.digests(path)
  local file = assert(io.open(path))
  local accepted = file:read "a"
  file:close()
  local asked = accepted:match "^[^\n]*"
  local pipe = assert(io.popen(("%s render %s --hash --progress none"):format(command, asked)))
  local lines = {}
  for line in pipe:lines() do lines[#lines + 1] = line end
  if not pipe:close() then return accepted, nil, "celspan render " .. asked .. " failed" end
  table.sort(lines, function(a, b) return tonumber(a:match "%S+") < tonumber(b:match "%S+") end)
  return accepted, asked .. "\n" .. table.concat(lines, "\n") .. "\n"
end

--- Lines of the two texts that are not in both, "- " the old and "+ " the new.
function golden.difference(old, new)
  local function lines_of(text)
    local list, set = {}, {}
    for line in text:gmatch "[^\n]+" do
      list[#list + 1] = line
      set[line] = true
    end
    return list, set
  end
  local old_list, old_set = lines_of(old)
  local new_list, new_set = lines_of(new)
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
