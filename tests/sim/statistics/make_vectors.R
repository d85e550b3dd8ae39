#!/usr/bin/env Rscript
# Writes the test vectors beside this script:  Rscript make_vectors.R [FOLDER]
# Samples are written with 17 significant digits, so that they read back as the same numbers.

arguments <- commandArgs(trailingOnly = FALSE)
script <- sub("^--file=", "", grep("^--file=", arguments, value = TRUE))
folder <- commandArgs(trailingOnly = TRUE)
folder <- if (length(folder) > 0) folder[1] else dirname(script)

RNGkind("Mersenne-Twister", "Inversion", "Rejection")
set.seed(20150711)

digits <- function(x) paste(sprintf("%.17g", x), collapse = " ")

pairs <- list(
  one_each = list(x = 1, y = 2),
  one_against_five = list(x = 2.5, y = c(1, 2, 3, 4, 5)),
  complete_separation = list(x = 1:7 / 8, y = 10:15 / 8),
  small = list(x = rnorm(4), y = rnorm(6)),
  small_shifted = list(x = rnorm(9, 1), y = rnorm(8)),
  middle = list(x = rexp(23), y = rexp(31, 1.5)),
  reference_size = list(x = rnorm(30, 160, 19), y = rnorm(30, 158, 19)),
  largest_exact = list(x = rnorm(49), y = rnorm(49, 0.3)),
  largest_exact_far_apart = list(x = rnorm(49), y = rnorm(49, 3)),
  first_normal_x = list(x = rnorm(50), y = rnorm(49, 0.3)),
  first_normal_y = list(x = rnorm(3), y = rnorm(50, 0.3)),
  paper_size = list(x = rnorm(64, 160, 19), y = rnorm(64, 155, 19)),
  paper_size_far_apart = list(x = rnorm(64, 160, 19), y = rnorm(64, 250, 19)),
  large = list(x = rlnorm(256), y = rlnorm(300, 0.1)),
  one_tie_across = list(x = c(1, 2, 3), y = c(3, 4, 5)),
  one_tie_within = list(x = c(1, 1, 3), y = c(2, 4, 5, 6)),
  few_levels = list(x = sample(1:4, 40, TRUE), y = sample(2:5, 35, TRUE)),
  reached_times = list(x = 100 * sample(20:80, 64, TRUE), y = 100 * sample(25:90, 64, TRUE)),
  never_reached = list(x = c(rep(40000, 60), 31000, 32000, 33000, 39900),
                       y = c(rep(40000, 62), 30000, 35000)),
  same_sample = local({ s <- rnorm(64); list(x = s, y = s) }),
  midpoint = list(x = c(1, 4), y = c(2, 3))
)

mann_whitney <- do.call(rbind, lapply(names(pairs), function(name) {
  x <- pairs[[name]]$x
  y <- pairs[[name]]$y
  test <- suppressWarnings(wilcox.test(x, y))
  a <- mean(outer(x, y, function(p, q) (p > q) + 0.5 * (p == q)))
  data.frame(
    case = name, x = digits(x), y = digits(y), u = sprintf("%.17g", test$statistic),
    p_value = sprintf("%.17g", test$p.value), a = sprintf("%.17g", a),
    exact = as.integer(grepl("exact", test$method))
  )
}))

# Two one-sided tests and intervals of the same pairs. R shifts x by its argument mu.
equivalence <- do.call(rbind, lapply(names(pairs), function(name) {
  x <- pairs[[name]]$x
  y <- pairs[[name]]$y
  margin <- 0.05 * max(abs(mean(y)), 0.5)
  above <- suppressWarnings(wilcox.test(x, y, mu = -margin, alternative = "greater"))
  below <- suppressWarnings(wilcox.test(x, y, mu = margin, alternative = "less"))
  test <- suppressWarnings(wilcox.test(x, y, conf.int = TRUE, conf.level = 0.9))
  data.frame(
    case = name, x = digits(x), y = digits(y), margin = sprintf("%.17g", margin),
    greater = sprintf("%.17g", above$p.value), less = sprintf("%.17g", below$p.value),
    shift = sprintf("%.17g", median(outer(x, y, "-"))),
    lower = sprintf("%.17g", test$conf.int[1]), upper = sprintf("%.17g", test$conf.int[2]),
    exact = as.integer(grepl("exact", test$method))
  )
}))

samples <- list(
  one = 3.25, two = c(7, -1), equal = rep(0.1, 6), odd = rnorm(31), even = rnorm(64, 160, 19),
  ties = sample(1:5, 20, TRUE), outliers = c(rnorm(12), 40, -35)
)
probabilities <- c(0, 0.025, 0.1, 0.25, 1 / 3, 0.5, 0.75, 0.9, 0.975, 1)

quantiles <- do.call(rbind, lapply(names(samples), function(name) {
  x <- samples[[name]]
  data.frame(
    case = name, sample = digits(x), probability = sprintf("%.17g", probabilities),
    quantile = sprintf("%.17g", quantile(x, probabilities, type = 7, names = FALSE))
  )
}))

families <- list(
  one = 0.03, ascending = c(0.001, 0.01, 0.02, 0.04), descending = c(0.9, 0.5, 0.04, 0.002),
  ties = c(0.02, 0.02, 0.5, 0.02), capped = c(0.6, 0.7, 0.8), extremes = c(0, 1, 0.5),
  many = runif(40)^3
)
holm <- do.call(rbind, lapply(names(families), function(name) {
  data.frame(case = name, p_values = digits(families[[name]]),
             corrected = digits(p.adjust(families[[name]], "holm")))
}))

# Differences within pairs: one test of their mean, two one-sided ones, and an interval.
differences <- list(
  two = c(0.5, -2), around_zero = rnorm(12), above = rnorm(30, 0.8), below = rnorm(64, -5, 19),
  far_above = rnorm(64, 60, 19), mostly_none = c(rep(0, 58), 12, -7.5, 30, -2, 0.25, -19),
  large = rnorm(256, 1.9, 27), skewed = rexp(40) - 1
)
paired <- do.call(rbind, lapply(names(differences), function(name) {
  d <- differences[[name]]
  margin <- max(0.25, 0.3 * sd(d))
  test <- t.test(d, conf.level = 0.9)
  data.frame(
    case = name, differences = digits(d), margin = sprintf("%.17g", margin),
    mean = sprintf("%.17g", mean(d)), lower = sprintf("%.17g", test$conf.int[1]),
    upper = sprintf("%.17g", test$conf.int[2]), p_value = sprintf("%.17g", test$p.value),
    greater = sprintf("%.17g", t.test(d, mu = -margin, alternative = "greater")$p.value),
    less = sprintf("%.17g", t.test(d, mu = margin, alternative = "less")$p.value)
  )
}))

save <- function(frame, name) {
  write.csv(frame, file.path(folder, name), row.names = FALSE, quote = FALSE)
}
save(mann_whitney, "mann_whitney.csv")
save(equivalence, "equivalence.csv")
save(holm, "holm.csv")
save(quantiles, "quantiles.csv")
save(paired, "paired.csv")
