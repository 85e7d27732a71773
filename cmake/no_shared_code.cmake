# Fails if OBJECT defines functions that the linker may take for those of other files (NM says W or u), or defines
# none at all.
execute_process(COMMAND "${NM}" "${OBJECT}" OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
if(NOT symbols MATCHES " T ")
  message(FATAL_ERROR "${OBJECT} defines no function")
endif()
if(symbols MATCHES "[0-9a-f]+ [Wui] ([^\n]*)")
  message(FATAL_ERROR "${OBJECT} shares ${CMAKE_MATCH_1}: compiled for one instruction set, it may run on others")
endif()
