# Shows what came of a tuning: elites.R LOG ELITES.CSV
#
# Writes the elite configurations, best first, as CSV: one column for each parameter. Prints the number
# of runs that irace counts as used.
options(digits = 15)
arguments <- commandArgs(trailingOnly = TRUE)
load(arguments[1])
if (iraceResults$state$completed == "Incomplete") stop("the tuning is not finished")
elites <- iraceResults$state$eliteConfigurations
write.csv(elites[iraceResults$parameters$names], arguments[2], row.names = FALSE)
cat(iraceResults$state$experimentsUsedSoFar, "\n")
