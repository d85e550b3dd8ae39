# Writes the completions and manual pages of PROGRAM into FOLDER.
function(write shell name)
    execute_process(COMMAND "${PROGRAM}" completion ${shell} OUTPUT_FILE "${FOLDER}/${name}"
        COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(MAKE_DIRECTORY "${FOLDER}/man1")
write(bash gene-clocks)
write(zsh _gene-clocks)
write(fish gene-clocks.fish)
execute_process(COMMAND "${PROGRAM}" manual --all "${FOLDER}/man1" COMMAND_ERROR_IS_FATAL ANY)
