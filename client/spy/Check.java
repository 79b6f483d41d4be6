// SPDX-FileCopyrightText: 2026 The graspd authors
// SPDX-License-Identifier: BSD-3-Clause
// Asks lcm-spy's own search for classes whether it finds graspd's types; one line each. No window is opened.
package graspd.spy;

public final class Check {
  private Check() {}

  public static void main(String[] arguments) throws Exception {
    lcm.spy.LCMTypeDatabase database = new lcm.spy.LCMTypeDatabase();
    int missing = 0;
    for (Class<?> type : Types.ALL) {
      long fingerprint = type.getField("LCM_FINGERPRINT").getLong(null);
      boolean found = database.getClassByFingerprint(fingerprint) == type;
      System.out.printf("%016x %s %s%n", fingerprint, type.getSimpleName(), found ? "found" : "missing");
      if (!found) missing++;
    }
    System.exit(missing == 0 ? 0 : 1);
  }
}
