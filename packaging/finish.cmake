# Called by CPack when the files of all packages are together: makes of them what Debian's rules ask for.
set(share "${CPACK_TEMPORARY_DIRECTORY}/*/usr/share")

# The licence is in the file copyright of each package, whose folder has the package's name.
file(GLOB licences "${share}/doc/*/LICENSE")
foreach(licence IN LISTS licences)
  file(REMOVE "${licence}")
  cmake_path(GET licence PARENT_PATH folder)
  file(GLOB others "${folder}/*")
  if(NOT others)
    file(REMOVE_RECURSE "${folder}")
  endif()
endforeach()

# Debian's zsh looks for what packages complete in another folder.
file(GLOB completions "${share}/zsh/site-functions")
foreach(folder IN LISTS completions)
  cmake_path(REPLACE_FILENAME folder vendor-completions OUTPUT_VARIABLE vendor)
  file(RENAME "${folder}" "${vendor}")
endforeach()

# Without the time in them.
file(GLOB long_texts "${share}/doc/*/changelog*" "${share}/man/man1/*.1")
execute_process(COMMAND gzip -9 -n ${long_texts} COMMAND_ERROR_IS_FATAL ANY)
