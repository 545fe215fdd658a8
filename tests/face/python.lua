-- A binding for Python's ctypes, from the declarations of the public headers. Pointers are
-- c_void_p, except for strings; functions that the library calls are made with CFUNCTYPE by
-- whoever needs them.

local python = {}

local SIMPLE = {
  bool = "c_bool", char = "c_char", double = "c_double", float = "c_float", int = "c_int",
  int32_t = "c_int32", int64_t = "c_int64", size_t = "c_size_t", uint8_t = "c_uint8",
  uint32_t = "c_uint32", uint64_t = "c_uint64", ["unsigned char"] = "c_ubyte", void = "None",
}

local names = {} -- of types: what Python calls them

local function type_of(base, stars, sizes)
  base = base:gsub("const%s+", ""):gsub("%s*const", ""):gsub("^struct%s+", ""):match "^%s*(.-)%s*$"
  local pointers = #(stars or "") + select(2, base:gsub("%*", ""))
  base = base:gsub("[%s%*]+$", "")
  local made = SIMPLE[base] or names[base] or "c_void_p"
  if pointers > 0 then made = base == "char" and pointers == 1 and "c_char_p" or "c_void_p" end
  local counts = {}
  for size in (sizes or ""):gmatch "%[(%d+)%]" do table.insert(counts, 1, size) end
  for _, count in ipairs(counts) do made = ("(%s * %s)"):format(made, count) end
  return made
end

local function argument(text)
  if text:find "%[" or text:find "%(%*" then return "c_void_p" end
  local base, stars = text:match "^%s*(.-)(%**)[%w_]*%s*$"
  return type_of(base == "" and text or base, stars)
end

local function arguments(list)
  local made, is_open = {}, false
  for text in (list:sub(2, -2) .. ","):gmatch "(.-)," do
    is_open = is_open or text:find("...", 1, true)
    if text:find "%w" and text ~= "void" then made[#made + 1] = argument(text) end
  end
  return table.concat(made, ", "), is_open
end

local function put_struct(put, struct)
  put(("class %s(Structure):"):format(struct.name))
  put "    _fields_ = ["
  for _, field in ipairs(struct.fields) do
    local made = field.is_function and "c_void_p" or type_of(field.type, field.stars, field.sizes)
    put(("        (%q, %s),"):format(field.name, made))
  end
  put "    ]"
end

function python.text(face)
  local lines = { "from ctypes import *", "", "lib = None", "" }
  local function put(line) lines[#lines + 1] = line end
  for _, callback in ipairs(face.callbacks) do names[callback.name] = "c_void_p" end
  for _, enum in ipairs(face.enums) do
    names[enum.name] = "c_int"
    for _, one in ipairs(enum.list) do put(("%s = %d"):format(one.name, one.value)) end
  end
  for _, struct in ipairs(face.structs) do
    put_struct(put, struct)
    names[struct.name] = struct.name
  end
  put "def load(path):"
  put "    global lib"
  put "    lib = CDLL(path)"
  for _, one in ipairs(face.functions) do
    local list, is_open = arguments(one.arguments)
    put(("    lib.%s.restype = %s"):format(one.name, type_of(one.result)))
    if not is_open then put(("    lib.%s.argtypes = [%s]"):format(one.name, list)) end
  end
  put "    return lib"
  put "def begin(kind):"
  put '    """A description with its defaults."""'
  put "    made = kind()"
  put '    getattr(lib, kind.__name__ + "_default")(byref(made), sizeof(kind))'
  put "    return made"
  return table.concat(lines, "\n") .. "\n"
end

return python
