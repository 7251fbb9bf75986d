"""Completion for bash from definitions. What it makes needs bash alone, not the package bash-completion."""

import common

# What every script begins with; several tools' scripts may define it again.
SHARED = r"""
# Those of the words that begin like the word at the cursor.
_vorion_words() { mapfile -t COMPREPLY < <(compgen -W "$*" -- "$cur"); }

# The same of a list with commas, of which the last is at the cursor.
_vorion_some() {
  local before=
  [[ $cur != *,* ]] || before=${cur%,*},
  mapfile -t COMPREPLY < <(compgen -P "$before" -W "$*" -- "${cur##*,}")
  compopt -o nospace 2>/dev/null
}

# Folders, and files with one of the endings; readline's own completion where there are none.
_vorion_files() {
  local name ending
  compopt -o filenames 2>/dev/null
  while IFS= read -r name; do
    if (($# == 0)) || [[ -d ${name/#\~\//$HOME/} ]]; then
      COMPREPLY+=("$name")
      continue
    fi
    for ending in "$@"; do
      [[ $name != *"$ending" ]] || { COMPREPLY+=("$name"); break; }
    done
  done < <(compgen -f -- "$cur")
  ((${#COMPREPLY[@]})) || compopt -o default 2>/dev/null
}

_vorion_folders() {
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -d -- "$cur")
}

# Where the value of option $1 is at the cursor: keys and values of a configuration, "key=" or "key=value" each. What we take
# for one word, "a=b,key=va", bash takes apart.
_vorion_settings() {
  local option=$1 at=$COMP_CWORD whole=${COMP_WORDS[COMP_CWORD]} typed item kept word full
  shift
  typed=${whole#=}
  while ((at > 1)) && [[ ${COMP_WORDS[at]} == = || ${COMP_WORDS[at - 1]} == = ]]; do whole=${COMP_WORDS[--at]}$whole; done
  if [[ $whole == "$option="* ]]; then whole=${whole#"$option="}
  elif [[ ${COMP_WORDS[at - 1]} != "$option" ]]; then return 1; fi
  item=${whole##*,} kept=${whole%"$typed"}
  for word; do
    [[ $item == *=* ]] || word=${word%%=*}=
    full=${whole%"$item"}$word
    full=${full#"$kept"}
    [[ $word != "$item"* || $word == "$item" || " ${COMPREPLY[*]} " == *" $full "* ]] || COMPREPLY+=("$full")
  done
  [[ $item == *=* ]] || compopt -o nospace 2>/dev/null
  return 0
}

# Views of the file that --cameras names on this command line, and other words.
_vorion_views() {
  local i file= name before=
  for ((i = 1; i < COMP_CWORD; ++i)); do
    [[ ${COMP_WORDS[i]} == --cameras ]] || continue
    [[ ${COMP_WORDS[i + 1]} != = ]] || ((++i))
    file=${COMP_WORDS[i + 1]}
  done
  [[ -n $file ]] || return
  [[ $cur != *,* ]] || before=${cur%,*},
  while IFS= read -r name; do
    [[ $name != "${cur##*,}"* ]] || COMPREPLY+=("$before$(printf %q "$name")")
  done < <(printf '%s\n' "$@"; "${COMP_WORDS[0]}" --print-views "${file/#\~\//$HOME/}" 2>/dev/null)
}
"""


def quoted(words):
    return " ".join("'" + word.replace("'", "'\\''") + "'" for word in words)


def action(value):
    """What completes a value; nothing where nothing is known of it."""
    words = value.get("words", [])
    if "names" in value:  # or a file
        return f"_vorion_words {quoted(value['names'])}; _vorion_files {quoted(words)}"
    return {"one-of": f"_vorion_words {quoted(words)}", "some-of": f"_vorion_some {quoted(words)}",
            "view": f"_vorion_views {quoted(words)}", "file": f"_vorion_files {quoted(words)}",
            "prefix": "_vorion_files", "folder": "_vorion_folders"}.get(value["kind"], "").strip()


def value_cases(command, options):
    for option in options:
        value = option.get("value")
        if not value or not option["names"]:
            continue
        keys = [f"'{command} {name}='" for name in option["names"]]
        if not value["optional"]:
            keys += [f"'{command} {name}'" for name in option["names"]]
        # Also where nothing is known of the value: no file is expected then.
        yield f"    {' | '.join(keys)}) {action(value) or ':'}; return ;;"


def rest(options, commands=()):
    """What is completed where no option's value is: options after a dash, else commands or files."""
    names = [name for option in options for name in option["names"] if common.is_plain(name)]
    values = [option["value"] for option in options if "position" in option]
    if commands:
        others = f"_vorion_words {quoted(commands)}"
    elif values:
        endings = [word for value in values for word in value.get("words", [])]
        others = f"_vorion_files {quoted(dict.fromkeys(endings))}".strip()
    else:  # a program of LLVM's, whose inputs no definition names
        others = "_vorion_files"
    return f"if [[ $cur == -* ]]; then _vorion_words {quoted(names)}; else {others}; fi"


def script(tool):
    name = tool["name"]
    function = "_vorion_complete_" + name.replace("-", "_")
    lines = [f"# Completion of {name} in bash, made from the definition of its command line.", SHARED,
             function + "() {", "  local cur=${COMP_WORDS[COMP_CWORD]} option= command= i", "  COMPREPLY=()",
             "  # bash takes --option=value apart.",
             "  if [[ $cur == = ]]; then", "    option=${COMP_WORDS[COMP_CWORD - 1]}= cur=",
             "  elif [[ ${COMP_WORDS[COMP_CWORD - 1]} == = ]]; then", "    option=${COMP_WORDS[COMP_CWORD - 2]}=",
             "  else", "    option=${COMP_WORDS[COMP_CWORD - 1]}", "  fi"]
    commands = tool.get("commands", [])
    if commands:
        takes = [n for o in tool["options"] if "value" in o for n in o["names"]]
        lines += ["  for ((i = 1; i < COMP_CWORD; ++i)); do", "    case ${COMP_WORDS[i]} in",
                  f"    {' | '.join(takes)}) [[ ${{COMP_WORDS[++i]}} != = ]] || ((++i)) ;;", "    =) ((++i)) ;;", "    -*) ;;",
                  "    *) command=${COMP_WORDS[i]}; break ;;", "    esac", "  done"]
    for option in tool["options"]:
        value = option.get("value", {})
        if value.get("kind") == "settings":
            words = [key + v for key, values in value["settings"].items() for v in values or [""]]
            lines += [f"  _vorion_settings {name} {quoted(words)} && return" for name in option["names"]]
    lines.append('  case "$command $option" in')
    lines += value_cases("", tool["options"] + tool.get("others", []))
    for command in commands:
        lines += value_cases(command["name"], common.options_in(tool, command))
    lines += ["  esac", "  case $command in"]
    for command in commands:
        lines.append(f"    {command['name']}) {rest(common.options_in(tool, command))} ;;")
    names = [c["name"] for c in commands]
    if commands:
        lines.append(f"    {common.HELP}) _vorion_words {quoted(names)} ;;")
        names.append(common.HELP)
    lines += [f"    '') {rest(tool['options'] + tool.get('others', []), names)} ;;", "  esac", "}",
              f"complete -F {function} {name}"]
    return "\n".join(lines) + "\n"
