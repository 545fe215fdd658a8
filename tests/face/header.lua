-- The public headers as tables: enumerations, structures with their fields, types of functions and
-- functions, in their order. It reads the C of these headers alone, not all of C.

local header = {}

--- Where the public headers are, for `include` and for a compiler.
local FOLDERS = { "src/core/include/", "src/kit/include/" }
header.INCLUDE = "-I" .. table.concat(FOLDERS, " -I")
--- The headers of the C library, in an order in which each needs only those before it.
header.FILES = { "celspan.h", "operators.h", "text.h", "svg.h", "layers.h", "trace.h", "plane.h",
  "relight.h", "track.h", "film.h" }
--- The header of the Lua face, which is a library of its own.
header.LUA = "lua.h"

--- The text of a header, which is in one of the folders.
local function read(root, name)
  local file
  for _, folder in ipairs(FOLDERS) do
    file = file or io.open(root .. folder .. "celspan/" .. name)
  end
  local text = assert(file, name):read "a"
  file:close()
  return text
end

--- The declarations of a header: no comments, no preprocessor, no inline functions.
local function plain(text)
  text = text:gsub("/%*.-%*/", " "):gsub("\\\n", " ")
  for name, number in text:gmatch "\n#define (CELSPAN_[%u_]+) (%d+)%s" do
    text = text:gsub("%[" .. name .. "%]", "[" .. number .. "]")
  end
  text = text:gsub("#ifdef __cplusplus.-#endif", ""):gsub("\n#[^\n]*", "\n")
  text = text:gsub("static inline [^{]-%b{}", ""):gsub("CELSPAN_FORMAT%b()", "")
  text = text:gsub("CELSPAN_API", ""):gsub("CELSPAN_CHECKED", "")
  text = text:gsub("CELSPAN_DESCRIPTION%(([%w_]+)%)",
    "void %1_default(%1 *out, size_t struct_size);"):gsub("CELSPAN_RESULT%b()", "")
  return (text:gsub("%s+", " "))
end

--- One declarator: its name, and what stands for the type around "$".
local function declarator(text, base)
  local result, name, arguments = text:match "^(.-)%(%*([%w_]+)%)(%b())$"
  if name then
    return { name = name, type = base, result = (base .. " " .. result), arguments = arguments,
      is_function = true }
  end
  local stars, word, sizes = text:match "^%s*([%*%sconst]-)([%w_]+)%s*([%[%]%w_]*)%s*$"
  assert(word, text)
  return { name = word, type = base, stars = (stars:gsub("[^%*]", "")), sizes = sizes }
end

--- "const celspan_point *points, *more" as declarators.
local function declarators(text)
  text = text:match "^%s*(.-)%s*$"
  if text:find "%(%*" then
    local base, rest = text:match "^([%w_]+)%s+(.*)$"
    local stars, tail = rest:match "^(%**)%s*(.*)$"
    local one = declarator(tail, base .. stars)
    return { one }
  end
  local base = text:match "^const%s+struct%s+[%w_]+" or text:match "^struct%s+[%w_]+"
    or text:match "^const%s+unsigned%s+char" or text:match "^unsigned%s+char"
    or text:match "^const%s+[%w_]+" or text:match "^[%w_]+"
  local list = {}
  for part in (text:sub(#base + 1) .. ","):gmatch "(.-)," do
    list[#list + 1] = declarator(part, base)
  end
  return list
end

local function fields(body)
  local list = {}
  for text in body:gmatch "([^;]+);" do
    if text:find "%S" then
      for _, field in ipairs(declarators(text)) do list[#list + 1] = field end
    end
  end
  return list
end

local function enumerators(body)
  local list, value = {}, -1
  for part in (body .. ","):gmatch "([^,]+)," do
    local name, given = part:match "([%w_]+)%s*=?%s*(%-?%d*)"
    if name then
      value = tonumber(given) or value + 1
      list[#list + 1] = { name = name, value = value }
    end
  end
  return list
end

local function parse(text, all)
  text = text:gsub("typedef enum ([%w_]+) (%b{}) %1 ?;", function(name, body)
    all.enums[#all.enums + 1] = { name = name, list = enumerators(body:sub(2, -2)) }
    return ""
  end)
  text = text:gsub("typedef struct ([%w_]+) (%b{}) %1 ?;", function(name, body)
    all.structs[#all.structs + 1] = { name = name, fields = fields(body:sub(2, -2)) }
    return ""
  end)
  text = text:gsub("typedef struct ([%w_]+) ([%w_]+) ?;", function(name)
    all.opaque[#all.opaque + 1] = name
    return ""
  end)
  text = text:gsub("typedef ([%w_%s]-[%s%*]+)%(%*([%w_]+)%)(%b()) ?;", function(result, name, list)
    all.callbacks[#all.callbacks + 1] = { name = name, result = result, arguments = list }
    return ""
  end)
  for result, name, list in text:gmatch "([%w_][%w_%s]-[%s%*]+)([%w_]*celspan[%w_]*)(%b()) ?;" do
    all.functions[#all.functions + 1] = { name = name, result = result, arguments = list }
  end
end

--- Everything that such declarations declare.
function header.parse(text)
  local all = { enums = {}, structs = {}, opaque = {}, callbacks = {}, functions = {} }
  parse(text:gsub("%s+", " "), all)
  return all
end

--- A line as several of up to 100 columns.
local function wrapped(line)
  local lines, now = {}, ""
  for word in line:gmatch "%S+" do
    if #now + #word > 98 then
      lines[#lines + 1] = now
      now = " "
    end
    now = now == "" and word or now .. " " .. word
  end
  lines[#lines + 1] = now
  return table.concat(lines, "\n")
end

--- The declarations of headers, by default of the library, each on lines of its own, as other
--- languages can take them. `root`: of the checkout, with a slash at its end.
function header.plain(root, files)
  local lines = {}
  for _, name in ipairs(files or header.FILES) do
    local text, depth, first = plain(read(root, name)), 0, 1
    for at, mark in text:gmatch "()([{};])" do
      depth = depth + (mark == "{" and 1 or mark == "}" and -1 or 0)
      if mark == ";" and depth == 0 then
        lines[#lines + 1] = text:sub(first, at):match "^%s*(.*)$"
        first = at + 1
      end
    end
  end
  for i, line in ipairs(lines) do lines[i] = wrapped(line) end
  return table.concat(lines, "\n") .. "\n"
end

--- The whole interface: the library, then the Lua face.
function header.whole(root)
  return header.plain(root) .. "typedef struct lua_State lua_State;\n"
    .. header.plain(root, { header.LUA })
end

return header
