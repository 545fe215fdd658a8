--- The modules of the page of celspan watch hold together. From the top of the tree:
---
---   lua5.4 tests/support/modules.lua
---
--- It prints what is wrong, and ends with 1 if something is: a module that `node --check` refuses
--- (where there is node); a name that is neither declared, imported nor the browser's, which would
--- silently be an element of the page with this id; an import that is not used, that something
--- else of its name hides, or that nothing exports; an export that nobody imports; a line of more
--- than 100 characters; a text that the server would change, which sends modules without comments
--- and indentation; an import or an export in a form that the server cannot join; a module that
--- comes before one that it needs, or is never reached; two modules with one name in the script
--- that they are joined to, or one that is the browser's.
local FOLDER = "src/desk/program/verbs/watch/"
local joining = dofile(FOLDER .. "joining.lua")

local browser = {}
for name in ([[
  Array AudioBuffer AudioBufferSourceNode AudioContext Blob Boolean Error ImageData Infinity
  Int16Array JSON Map Math NaN Number Object Promise ResizeObserver Set String URL URLSearchParams
  Uint32Array Uint8Array Uint8ClampedArray async await break catch class clearTimeout console const
  continue default delete do document else export false finally for from function
  getComputedStyle history if import in innerHeight innerWidth instanceof isNaN let localStorage
  location matchMedia navigator new null of performance requestAnimationFrame return setTimeout
  structuredClone super switch this throw true try typeof undefined var void while window yield
  encodeURIComponent case as arguments $]]):gmatch "%S+" do browser[name] = true end

local faults = {}
local function complain(...) faults[#faults + 1] = (...):format(select(2, ...)) end

local function read(path)
  local file = assert(io.open(path, "rb"))
  local text = file:read "a"
  file:close()
  return text
end

--- The text without comments, with the contents of texts taken out, and what stands in `${}` kept.
local function bare(text)
  text = text:gsub("/%*.-%*/", " "):gsub("(\n%s*)//[^\n]*", "%1"):gsub("^//[^\n]*", "")
    :gsub("(%s)// [^\n]*", "%1"):gsub("\\.", ""):gsub('"[^"\n]*"', '""')
    :gsub("'[^'\n]*'", "''"):gsub("([=(,:&|?]%s*)/[^/\n]+/[gimsuy]*", "%1''")
  return (text:gsub("`([^`]*)`", function(inner)
    local kept = {}
    for one in inner:gmatch "%${(.-)}" do kept[#kept + 1] = "(" .. one .. ")" end
    return table.concat(kept, " ")
  end))
end

--- Notes every name in a pattern, such as { a, b: [c] }.
local function note(names, pattern)
  for name in pattern:gmatch "[%a_$][%w_$]*" do names[name] = true end
end

local function declared(text)
  local names = {}
  for name in text:gmatch "function%s+([%a_$][%w_$]*)" do names[name] = true end
  for list in text:gmatch "function[^(]*(%b())" do note(names, list) end
  for list in text:gmatch "(%b())%s*=>" do note(names, list) end
  for name in text:gmatch "([%a_$][%w_$]*)%s*=>" do names[name] = true end
  for list in text:gmatch "catch%s*(%b())" do note(names, list) end
  for _, word in ipairs { "const", "let" } do
    for rest in text:gmatch("%f[%w]" .. word .. "%s+([^;]-)[;]") do
      note(names, rest:match "^%b{}" or rest:match "^%b[]" or rest:match "^[%w_$]+" or "")
      for more in rest:gmatch ",%s*([%a_$][%w_$]*)%s*=[^=>]" do names[more] = true end
      for more in rest:gmatch ",%s*(%b{})%s*=" do note(names, more) end
      for more in rest:gmatch ",%s*(%b[])%s*=" do note(names, more) end
    end
    for rest in text:gmatch("%f[%w]" .. word .. "%s+(%b{})") do note(names, rest) end
    for rest in text:gmatch("%f[%w]" .. word .. "%s+(%b[])") do note(names, rest) end
    for name in text:gmatch("%f[%w]" .. word .. "%s+([%a_$][%w_$]*)") do names[name] = true end
  end
  return names
end

--- The names of the constants and variables of a module and its functions.
local function stored(text)
  local names = {}
  for rest in text:gmatch "%f[%w][cl][oe][nt]s?t?%s+([%a_$][^;]-);" do
    for name in ("," .. rest):gmatch ",%s*([%a_$][%w_$]*)%s*=[^=>]" do names[name] = true end
  end
  return names
end

local exports, imports, texts = {}, {}, {}

local function take_module(name, text)
  exports[name], imports[name] = {}, {}
  for word in text:gmatch "\nexport%s+[%a ]-([%a_$][%w_$]*)%s*[=(]" do
    exports[name][word] = true
  end
  for word in text:gmatch "\nexport let%s+([%a_$][%w_$]*)" do exports[name][word] = true end
  for list, from in text:gmatch 'import {([^}]*)} from "/([%w.]+)"' do
    for word in list:gmatch "[%a_$][%w_$]*" do imports[name][word] = from end
  end
  texts[name] = bare((("\n" .. text):gsub("\nimport [^;]*;", "\n")))
end

--- Whether a text that begins in this part of a line does not end in it.
local function has_open_text(part)
  local rest = part:gsub("\\.", "")
  if rest:find "^%s*/?%*" or rest:find "^%s*//" then return false end -- a comment
  for _, quote in ipairs { "`", '"', "'" } do
    rest = rest:gsub(quote .. "[^" .. quote .. "]*" .. quote, "")
  end
  return rest:find "[`\"']" ~= nil
end

local listing = assert(io.popen("ls " .. FOLDER))
for name in listing:lines() do
  if name:find "%.js$" then
    local text = read(FOLDER .. name)
    take_module(name, text)
    local number = 0
    for line in text:gmatch "([^\n]*)\n" do
      number = number + 1
      if utf8.len(line) > 100 then
        complain("%s:%d: more than 100 characters", name, number)
      end
      if has_open_text(line:match "^(.-) // " or line) then
        complain("%s:%d: a text with ' // ', or of several lines", name, number)
      end
    end
  end
end
listing:close()

local wanted = {}
for name, text in pairs(texts) do
  local known, used, hidden = declared(text), {}, stored(text)
  for before, word in text:gmatch "([^%w_$]?[^%w_$]?[^%w_$]?)([%a_$][%w_$]*)" do
    local is_member = before:find "%.$" and not before:find "%.%.%.$"
    if not is_member then used[word] = true end
  end
  for word, from in pairs(imports[name]) do
    if not used[word] then complain("%s: the import %s is not used", name, word) end
    if hidden[word] then complain("%s: the import %s is hidden by another", name, word) end
    if not exports[from][word] then complain("%s: %s does not export %s", name, from, word) end
    wanted[from .. word] = true
  end
  for at, word, after in text:gmatch "()%f[%w_$]([%a_$][%w_$]*)()" do
    local before = text:sub(math.max(1, at - 40), at - 1):match "[^%s]*%s*$"
    local is_key = text:find("^%s*:", after) and not before:find "%?%s*$"
      or before:find "%.$" and not before:find "%.%.%.$" or before:find "%?%.$"
    if not is_key and not known[word] and imports[name][word] == nil and not browser[word] then
      complain("%s: %s is not declared", name, word)
      known[word] = true
    end
  end
end
for name, list in pairs(exports) do
  for word in pairs(list) do
    if not wanted[name .. word] then complain("%s: nobody imports %s", name, word) end
  end
end

-- ---------------------------------------------------------------- the joined script

local function text_of(name) return read(FOLDER .. name) end

--- Whether a module needs another one, by whatever way.
local function reaches(from, to, seen)
  if from == to then return true end
  if seen[from] then return false end
  seen[from] = true
  for _, next in pairs(imports[from]) do
    if reaches(next, to, seen) then return true end
  end
  return false
end

local function check_order(order)
  local place = {}
  for i, name in ipairs(order) do place[name] = i end
  for name in pairs(texts) do
    if not place[name] then complain("page.js does not need %s", name) end
    for _, from in pairs(place[name] and imports[name] or {}) do
      if place[from] > place[name] and not reaches(from, name, {}) then
        complain("%s comes before %s, which it needs", name, from)
      end
    end
  end
end

--- Names that modules declare for themselves alone are names of the whole script.
local function check_names()
  local owner = {}
  for name in pairs(texts) do
    local text = "\n" .. text_of(name)
    for _, form in ipairs { "function", "const", "let" } do
      for word in text:gsub("\nexport ", "\n"):gsub("\nasync ", "\n")
        :gmatch("\n" .. form .. " ([%w_$]+)") do
        if owner[word] then complain("%s and %s both have a %s", owner[word], name, word) end
        if browser[word] then complain("%s: %s is a name of the browser", name, word) end
        owner[word] = name
      end
    end
  end
end

--- Asks node whether a text is a module.
local function is_module(text)
  local pipe = assert(io.popen("node --input-type=module --check", "w"))
  pipe:write(text)
  return pipe:close()
end

local joined = joining.join("page.js", text_of)
check_order(joining.order("page.js", text_of))
check_names()
for line in joined:gmatch "[^\n]+" do
  if line:find "^import%f[%W]" or line:find "^export%f[%W]" then
    complain("the joined script keeps: %s", line)
  end
end
if os.execute "command -v node >/dev/null" then
  for name in pairs(texts) do
    if not is_module(text_of(name)) then complain("%s: node refuses it", name) end
  end
  if not is_module(joined) then complain "node refuses the joined script" end
end

table.sort(faults)
for _, fault in ipairs(faults) do print(fault) end
os.exit(#faults == 0)
