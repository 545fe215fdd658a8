--- Completions for a shell, made from the verbs and their options. Returns the text of the file, or
--- nil for another shell. formats: the names that --format takes, by the name of the verb.
local verbs, shell, formats = ...

--- A word in quotes for all three shells.
local function quoted(word) return "'" .. word:gsub("'", "'\\''") .. "'" end

--- A help text up to its first semicolon, without the full stop at its end.
local function brief(help)
  return (help:gsub("%s+", " "):gsub(";.*", ""):gsub("%.$", ""))
end

local function names_of(list, only)
  local names = {}
  for _, one in ipairs(list) do
    if not only or only(one) then names[#names + 1] = one.name end
  end
  return table.concat(names, " ")
end

local function takes_value(option) return option.value end

local writers = {}

local BASH = [==[
# Completion of celspan for bash.
_celspan() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}
  local verbs="%s help" options="" valued="" formats=""
  COMPREPLY=()
  if [ "$COMP_CWORD" = 1 ] || [[ $COMP_CWORD = 2 && ${COMP_WORDS[1]} = help ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$verbs" -- "$word")
    return
  fi
  case ${COMP_WORDS[1]} in
%s  esac
  if [ "$before" = --format ]; then
    mapfile -t COMPREPLY < <(compgen -W "$formats" -- "$word")
    return
  fi
  [[ $word = -* && " ${COMP_WORDS[*]:0:COMP_CWORD} " != *" -- "* ]] || return
  [[ " $valued " = *" $before "* ]] ||
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$word")
}
complete -o default -F _celspan celspan
]==]

function writers.bash()
  local rows = {}
  for _, verb in ipairs(verbs) do
    rows[#rows + 1] = ('    %s)\n      options="%s"\n      valued="%s"\n'
      .. '      formats="%s"\n      ;;\n'):format(verb.name, names_of(verb.options),
      names_of(verb.options, takes_value), formats[verb.name])
  end
  return BASH:format(names_of(verbs), table.concat(rows))
end

local ZSH = [==[
#compdef celspan
_celspan() {
  local -a verbs=(
%s  )
  if (( CURRENT == 2 )) || [[ CURRENT -eq 3 && $words[2] = help ]]; then
    _describe verb verbs
    return
  fi
  local verb=$words[2]
  shift words
  (( CURRENT-- ))
  case $verb in
%s  esac
}
_celspan "$@"
]==]

--- A help text in the form for brackets of _arguments.
local function bracketed(help) return (brief(help):gsub("[%[%]:\\]", "\\%0")) end

local function zsh_option(verb, option)
  local choice = option.is_format and (":(%s)"):format(formats[verb.name]) or ":_files"
  local value = option.value and ":" .. option.value:gsub(":", "\\:") .. choice or ""
  local words = ("*%s[%s]%s"):format(option.name, bracketed(option.help), value)
  return "      " .. quoted(words) .. " \\\n"
end

function writers.zsh()
  local names, rows = {}, {}
  for _, verb in ipairs(verbs) do
    local options = {}
    for i, option in ipairs(verb.options) do options[i] = zsh_option(verb, option) end
    names[#names + 1] = "    " .. quoted(verb.name .. ":" .. brief(verb.summary)) .. "\n"
    rows[#rows + 1] = ("    %s) _arguments \\\n%s      '*:file:_files' ;;\n")
      :format(verb.name, table.concat(options))
  end
  names[#names + 1] = "    'help:Describes a verb, or shows how to make a thing'\n"
  return ZSH:format(table.concat(names), table.concat(rows))
end

local function fish_option(verb, option)
  local dash, name = option.name:match "^(%-+)(.*)"
  local value = option.is_format and " -x -a " .. quoted(formats[verb.name])
    or option.value and " -r" or ""
  return ("complete -c celspan -n '__fish_seen_subcommand_from %s' %s %s%s -d %s\n")
    :format(verb.name, dash == "-" and "-s" or "-l", name, value, quoted(brief(option.help)))
end

function writers.fish()
  local rows = { "# Completion of celspan for fish.\n" }
  for _, verb in ipairs(verbs) do
    rows[#rows + 1] = ("complete -c celspan -n __fish_use_subcommand -f -a %s -d %s\n")
      :format(verb.name, quoted(brief(verb.summary)))
    for _, option in ipairs(verb.options) do rows[#rows + 1] = fish_option(verb, option) end
  end
  rows[#rows + 1] = ("complete -c celspan -n __fish_use_subcommand -f -a help -d %s\n"
    .. "complete -c celspan -n '__fish_seen_subcommand_from help' -f -a %s\n")
    :format("'Describes a verb, or shows how to make a thing'", quoted(names_of(verbs)))
  return table.concat(rows)
end

return writers[shell] and writers[shell]()
