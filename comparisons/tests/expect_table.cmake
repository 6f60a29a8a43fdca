# Runs COMMAND, which must succeed and write TABLE with the columns of the contract, ROWS rows, no
# failed method and no number that is none.
execute_process(COMMAND ${COMMAND} RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT code EQUAL 0)
  message(FATAL_ERROR "exit code ${code}:\n${output}")
endif()
file(STRINGS ${TABLE} lines)
list(POP_FRONT lines header)
string(
  CONCAT columns "method,ranks,parts,points,dim,workload,layout,lists,repeats,time_ms_median,"
         "time_ms_min,time_ms_max,imbalance,lu_max_percent,messages,bytes,root_bytes_in,"
         "collectives,communicators,moved_fraction,time_vs_zoltan_rcb,time_ms_low,time_ms_high,"
         "time_vs_zoltan_rcb_low,time_vs_zoltan_rcb_high,imbalance_low,imbalance_high,seeds,"
         "lu_worst_percent,error")
if(NOT header STREQUAL columns)
  message(FATAL_ERROR "columns of ${TABLE}:\n${header}\ninstead of\n${columns}")
endif()
list(LENGTH lines rows)
if(NOT rows EQUAL ROWS)
  message(FATAL_ERROR "${rows} rows in ${TABLE} instead of ${ROWS}")
endif()
foreach(line IN LISTS lines)
  # A name, numbers and words, no intervals of times (there are too few repeats) and an empty error.
  string(REGEX REPLACE "^\"[^\"]+\"" "name" plain "${line}")
  if(NOT plain MATCHES "^([^,]+,)+,,,,([^,]+,)+$" OR plain MATCHES "nan|inf")
    message(FATAL_ERROR "a row of ${TABLE} lacks a value:\n${line}")
  endif()
endforeach()
get_filename_component(folder ${TABLE} DIRECTORY)
file(READ ${folder}/run.txt record)
if(NOT record MATCHES "\nbusy: (yes|no|)\n")
  message(FATAL_ERROR "run.txt does not tell whether the machine was busy:\n${record}")
endif()
file(READ ${folder}/noise.csv noise)
if(NOT noise MATCHES "^workload,what,ratio,low,high\n" OR NOT noise MATCHES ",zoltan-rcb,[0-9.e+-]+,,\n")
  message(FATAL_ERROR "noise.csv lacks zoltan-rcb beside itself:\n${noise}")
endif()
